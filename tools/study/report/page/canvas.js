// A canvas in CSS pixels, sharp on any screen, and the colours of the page.

function colour(name) { return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim(); }

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

// A text with the panel's colour behind it.
function label(pen, words, x, y, style, align) {
  pen.textAlign = align || 'left';
  pen.lineWidth = 4;
  pen.lineJoin = 'round';
  pen.strokeStyle = colour('panel');
  pen.strokeText(words, x, y);
  pen.fillStyle = style;
  pen.fillText(words, x, y);
}

// Lines of parts [text, style, is_struck], aligned as one block that begins at y.
function label_lines(pen, lines, x, y, align) {
  lines.forEach((parts, row) => {
    const width = parts.reduce((total, [text]) => total + pen.measureText(text).width, 0);
    let at = x - (align === 'right' ? width : align === 'center' ? width / 2 : 0);
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
