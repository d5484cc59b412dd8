// A second run beside that of a report: a table of `pose_wall run` that the reader drops onto the page.

// Rows of cells, by RFC 4180.
function csv_rows(text) {
  const rows = [];
  let row = [], cell = '', is_quoted = false;
  const end_row = () => { if (row.length || cell) rows.push([...row, cell]); row = []; cell = ''; };
  for (let k = 0; k < text.length; ++k) {
    const c = text[k];
    if (is_quoted) {
      if (c !== '"') cell += c;
      else if (text[k + 1] === '"') { cell += c; ++k; } else is_quoted = false;
    } else if (c === '"') is_quoted = true;
    else if (c === ',') { row.push(cell); cell = ''; } else if (c === '\n') end_row();
    else if (c !== '\r' && c !== '\ufeff') cell += c;
  }
  end_row();
  return rows;
}

// The same file may be named from another folder.
function is_same_source(a, b) {
  const [long, short] = [a, b].map((path) => path.split('/').filter((part) => part && !part.startsWith('.'))).sort((x, y) => y.length - x.length);
  return short.every((part, k) => part === long[long.length - short.length + k]);
}

// Values and states by the frames of the report; NaN where the second run has none. Throws the name of a word.
class SecondRun {
  constructor(recording, name, text) {
    Object.assign(this, { recording, name, matched: 0, by: 'stamp', others: 0, source: '' });
    const [head = [], ...rows] = csv_rows(text), column = (title) => head.indexOf(title);
    if (column('frame') < 0 || QUANTITIES.some((q) => column(q) < 0 || column(`${q}_state`) < 0)) throw new Error('no_table_of_run');
    this.value = new Float32Array(7 * recording.frames).fill(NaN);
    this.state = new Uint8Array(7 * recording.frames).fill(UNREADABLE);
    this.there = new Uint8Array(recording.frames);
    const stamp = column('stamp_ns'), by_stamp = new Map(Array.from(recording.stamp_s.subarray(0, recording.frames), (s, f) => [s, f]));
    // The program made the page's seconds by the same product.
    let pairs = stamp < 0 ? [] : rows.map((row) => [by_stamp.get(1e-9 * Number(row[stamp])), row]).filter(([f]) => f !== undefined);
    if (!pairs.length || by_stamp.size < recording.frames / 2) {
      this.by = 'frame';
      pairs = rows.map((row) => [Number(row[column('frame')]), row]).filter(([f]) => Number.isInteger(f) && f >= 0 && f < recording.frames);
    }
    for (const [f, row] of pairs) this.take(f, row, column);
    const source = column('source');
    for (const [f, row] of source < 0 ? [] : pairs) {
      if (is_same_source(row[source], recording.source[f])) continue;
      ++this.others;
      this.source = this.source || row[source];
    }
    if (!this.matched) throw new Error('no_frame_in_common');
  }

  take(f, row, column) {
    this.matched += this.there[f] ? 0 : 1;
    this.there[f] = 1;
    QUANTITIES.forEach((name, q) => {
      const i = this.recording.at(f, q), state = STATES.indexOf(row[column(`${name}_state`)]), cell = row[column(name)];
      this.state[i] = state < 0 ? UNREADABLE : state;
      this.value[i] = cell === '' || state === INVALID || state < 0 ? NaN : Number(cell);
    });
  }

  has(f) { return this.there[f] > 0; }

  // The second less the first, in degrees or m; NaN unless both have a value.
  difference(f, q) {
    const r = this.recording, i = r.at(f, q);
    if (r.state[i] === INVALID || r.state[i] === UNREADABLE) return NaN;
    const apart = this.value[i] - r.value[i];
    return (r.is_angle(q) ? Math.atan2(Math.sin(apart), Math.cos(apart)) : apart) * r.unit(q);
  }

  // Of the frames in which both are valid.
  summary(q) {
    const r = this.recording, apart = [];
    let squares = 0, largest = 0, at = -1;
    for (let f = 0; f < r.frames; ++f) {
      const i = r.at(f, q), d = this.difference(f, q);
      if (r.state[i] !== VALID || this.state[i] !== VALID || !Number.isFinite(d)) continue;
      apart.push(d);
      squares += d * d;
      if (Math.abs(d) >= largest) [largest, at] = [Math.abs(d), f];
    }
    return { q, frames: apart.length, median: quantile(apart, 0.5), rms: apart.length ? Math.sqrt(squares / apart.length) : NaN, largest: at < 0 ? NaN : largest, at };
  }
}

// The part of the page that takes the file and says how the two runs differ.
class Compare {
  constructor() {
    this.fault = '';
    const input = document.getElementById('compare-file');
    input.addEventListener('change', () => { if (input.files.length) this.take(input.files[0]); });
    document.addEventListener('dragover', (event) => event.preventDefault());
    document.addEventListener('drop', (event) => {
      event.preventDefault();
      if (event.dataTransfer.files.length) this.take(event.dataTransfer.files[0]);
    });
    on('compare-apart', 'change', () => { charts.is_apart = document.getElementById('compare-apart').checked; charts.draw(); });
    on('compare-end', 'click', () => this.end());
  }

  async take(file) {
    try {
      recording.other = new SecondRun(recording, file.name, await file.text());
      this.fault = '';
    } catch (fault) {
      this.fault = words()[fault.message] ? fault.message : 'no_table_of_run';
    }
    this.show();
    charts.draw();
  }

  end() {
    recording.other = null;
    charts.is_apart = document.getElementById('compare-apart').checked = false;
    document.getElementById('compare-file').value = '';
    this.show();
    charts.draw();
  }

  show() {
    const w = words(), other = recording.other;
    document.getElementById('compare-fault').textContent = this.fault && w[this.fault];
    document.getElementById('compare').hidden = !other;
    if (!other) return;
    const how = other.by === 'stamp' ? w.by_stamp : w.by_frame;
    document.getElementById('compare-line').textContent = w.compared_with(other.name, other.matched, recording.frames, how);
    const summaries = QUANTITIES.map((_, q) => other.summary(q)), doubts = [];
    if (other.others) doubts.push(w.other_sources(other.others, other.source));
    if (!summaries.some((x) => x.frames)) doubts.push(w.never_both_valid);
    document.getElementById('compare-doubt').textContent = w.sentences(doubts);
    fill('compare-table', table(['', w.both_valid, w.median_apart, w.rms_apart, w.largest_apart, w.at_frame], summaries.map((x, q) => {
      const amount = (v) => amount_text(recording, q, v), link = element('td');
      if (x.at >= 0) link.append(Object.assign(element('a', String(x.at)), { href: `#${x.at}` }));
      return [name_text(q), String(x.frames), amount(x.median), amount(x.rms), amount(x.largest), link];
    })));
  }
}
