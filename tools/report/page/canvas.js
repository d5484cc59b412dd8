// A canvas in CSS pixels, sharp on any screen, and the page's colours.

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

// Words with the panel's colour behind them.
function label(pen, words, x, y, style, align) {
  pen.textAlign = align || 'left';
  pen.lineWidth = 4;
  pen.lineJoin = 'round';
  pen.strokeStyle = colour('panel');
  pen.strokeText(words, x, y);
  pen.fillStyle = style;
  pen.fillText(words, x, y);
}

// A round step so that about `most` of them fit into the span.
function round_step(span, most) {
  const rough = span / most, power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((k) => k * power).find((step) => step >= rough);
}
