// A canvas in CSS pixels, sharp on any screen, and the colours of the page.

function colour(name, node = document.documentElement) { return getComputedStyle(node).getPropertyValue(`--${name}`).trim(); }

// As the reader's system has it, now and later, until the reader chooses by the button. Paper is light: pictures are drawn
// anew for it. redraw: draws them, where there are any.
function follow_theme(redraw) {
  const root = document.documentElement, dark = window.matchMedia('(prefers-color-scheme: dark)');
  let chosen = null, on_screen = null;
  const show = (theme) => { root.dataset.theme = theme; redraw(); };
  const usual = () => chosen || (dark.matches ? 'dark' : 'light');
  root.dataset.theme = usual();
  dark.addEventListener('change', () => show(usual()));
  document.getElementById('theme').addEventListener('click', () => show(chosen = root.dataset.theme === 'dark' ? 'light' : 'dark'));
  window.addEventListener('beforeprint', () => { on_screen = root.dataset.theme; show('light'); });
  window.addEventListener('afterprint', () => { if (on_screen) show(on_screen); on_screen = null; });
}

function begin(canvas) {
  const scale = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = Math.round(width * scale);
  canvas.height = Math.round(height * scale);
  const pen = canvas.getContext('2d');
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = '12px system-ui, sans-serif';
  return { pen, width, height };
}

const kEdge_px = 4;  // a label keeps so far from the edge of its picture

// The words of a tick, wholly inside and clear of the ones before; its mark is drawn without them as well. ends: of the last
// words that were drawn, kept by the caller in one array for an axis.
function tick_label(pen, words, x, y, ends, width) {
  const half = pen.measureText(words).width / 2;
  if (x - half < kEdge_px || x + half > width - kEdge_px || ends.some((end) => Math.abs(end - x) < kTickApart_px)) return;
  ends.push(x);
  label(pen, words, x, y, colour('faint'), 'center');
}
const kTickApart_px = 70;  // the time of day has some 55

function stroke(pen, points, style, width, dash) {
  pen.beginPath();
  points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  pen.strokeStyle = style;
  pen.lineWidth = width;
  pen.setLineDash(dash || []);
  pen.stroke();
  pen.setLineDash([]);
}

function dot(pen, [x, y], radius, fill) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fillStyle = fill;
  pen.fill();
}

function ring(pen, [x, y], radius, style) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.strokeStyle = style;
  pen.lineWidth = 1;
  pen.stroke();
}

// A text with the panel's colour, or another ground's, behind it.
function label(pen, words, x, y, style, align, ground = colour('panel')) {
  pen.textAlign = align || 'left';
  pen.lineWidth = 4;
  pen.lineJoin = 'round';
  pen.strokeStyle = ground;
  pen.strokeText(words, x, y);
  pen.fillStyle = style;
  pen.fillText(words, x, y);
}

// Lines of parts [text, style, is_struck], aligned as one block that begins at y; none leaves the canvas while it has room.
function label_lines(pen, lines, x, y, align) {
  lines.forEach((parts, row) => {
    const width = parts.reduce((total, [text]) => total + pen.measureText(text).width, 0);
    const wish = x - (align === 'right' ? width : align === 'center' ? width / 2 : 0);
    let at = Math.max(kEdge_px, Math.min(wish, pen.canvas.clientWidth - kEdge_px - width));
    for (const [text, style, is_struck] of parts) {
      const end = at + pen.measureText(text).width, line_y = y + 15 * row;
      label(pen, text, at, line_y, style);
      if (is_struck) stroke(pen, [[at, line_y - 4], [end, line_y - 4]], style, 1.2);
      at = end;
    }
  });
}

// A round step so that about `most` of them fit into the span.
function round_step(span, most) {
  const rough = span / most, power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((k) => k * power).find((step) => step >= rough);
}
