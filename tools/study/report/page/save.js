// What a page shows as files: its pictures as PNG, the numbers of its charts as CSV.

function save_file(name, blob) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// Some canvases as one picture, one below the other, on the page's colour.
function picture_of(canvases) {
  const out = document.createElement('canvas'), pen = out.getContext('2d');
  out.width = Math.max(...canvases.map((canvas) => canvas.width));
  out.height = canvases.reduce((sum, canvas) => sum + canvas.height, 0);
  pen.fillStyle = colour('panel');
  pen.fillRect(0, 0, out.width, out.height);
  let y = 0;
  for (const canvas of canvases) {
    pen.drawImage(canvas, 0, y);
    y += canvas.height;
  }
  return out;
}

function file_name(what, ending) {
  const moment = moment_text(recording, recording.stamp_s[page.frame], 1).replace(/[: ]/g, '-');
  return `${(recording.head.title || 'pose_wall').replace(/[^\w.-]+/g, '_')}_${moment}_${what}.${ending}`;
}

function save_picture(what, canvases) {
  if (canvases[0].id === 'space') viewer.space.scene.render();  // what it drew before is gone by now
  picture_of(canvases).toBlob((blob) => save_file(file_name(what, 'png'), blob));
}

// Of the frames that the charts show, in the units of the page. With a second run its values and the difference.
function csv_text(from, to) {
  const r = recording, clocks = has_clock(r), head = ['frame', 'stamp_s', ...(clocks ? ['clock'] : [])], lines = [];
  QUANTITIES.forEach((name, q) => {
    const unit = r.is_angle(q) ? 'deg' : 'm';
    head.push(`${name}_${unit}`, `${name}_error_at_most_${unit}`, `${name}_state`);
    if (r.has_truth) head.push(`${name}_truth_${unit}`);
    if (r.other) head.push(`${name}_second_${unit}`, `${name}_difference_${unit}`, `${name}_second_state`);
  });
  const number = (x) => (Number.isFinite(x) ? String(Number(x.toFixed(6))) : '');
  for (let f = from; f <= to; ++f) {
    const cells = [r.number_of(f), r.stamp_s[f].toFixed(6), ...(clocks ? [moment_text(r, r.stamp_s[f], 3)] : [])];
    QUANTITIES.forEach((_, q) => {
      const i = r.at(f, q), unit = r.unit(q), is_there = r.state[i] !== INVALID && r.state[i] !== UNREADABLE;
      cells.push(is_there ? number(r.value[i] * unit) : '', number(r.bound_of(f, q)), STATES[r.state[i]]);
      if (r.has_truth) cells.push(number(r.truth[i] * unit));
      if (r.other) cells.push(number(r.other.value[i] * unit), number(r.other.difference(f, q)), r.other.has(f) ? STATES[r.other.state[i]] : '');
    });
    lines.push(cells.join(','));
  }
  return `${[head.join(','), ...lines].join('\n')}\n`;
}

// A button beside each picture, once; and those of the charts.
function add_savers() {
  for (const canvas of document.querySelectorAll('figure > canvas')) {
    const button = Object.assign(document.createElement('button'), { type: 'button', className: 'save', textContent: 'PNG' });
    button.dataset.hint = 'save_png';
    button.addEventListener('click', () => save_picture(canvas.id, [canvas]));
    canvas.after(button);
  }
  document.getElementById('charts-png').addEventListener('click', () => save_picture('values', charts.canvases));
  document.getElementById('charts-csv').addEventListener('click', () => {
    const text = csv_text(Math.max(0, Math.floor(charts.from)), Math.min(recording.frames - 1, Math.ceil(charts.to)));
    save_file(file_name('values', 'csv'), new Blob([text], { type: 'text/csv' }));
  });
}

// Hints of buttons in the language of the page.
function show_hints() { document.querySelectorAll('[data-hint]').forEach((node) => { node.title = words()[node.dataset.hint]; }); }
