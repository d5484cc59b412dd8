// Tables and words of a frame, for the report and for the live page. Both have the globals recording, viewer and page.

function element(tag, text, name) {
  const out = document.createElement(tag);
  if (text !== undefined) out.textContent = text;
  if (name) out.className = name;
  return out;
}

function table(head, rows) {
  const out = element('table'), top = element('tr');
  head.forEach((words) => top.append(element('th', words)));
  out.append(top);
  for (const cells of rows) {
    const row = element('tr');
    for (const cell of cells) row.append(cell instanceof Node ? cell : element('td', cell));
    out.append(row);
  }
  return out;
}

function fill(id, ...nodes) { document.getElementById(id).replaceChildren(...nodes); }

function words() { return WORDS[page.language]; }

// A number and its sign stay on one line.
function percent(share) { return `${(100 * share).toFixed(1)}\u00a0%`; }
function whole_percent(share) { return `${Math.round(100 * share)}\u00a0%`; }

function reason_text(bit) {
  const name = recording.words.reason_names[bit];
  return words().reason_texts ? words().reason_texts[name] || name : recording.words.reason_texts[bit];
}

function part_text(part) { return words().parts[recording.words.parts[part]] || recording.words.parts[part]; }

function stage_text(stage) { return words().stages[recording.words.stages[stage]] || recording.words.stages[stage]; }

function sense_text(sense) {
  const name = recording.words.senses[sense];
  return words().senses ? words().senses[name] || name : name;
}

// An angle with the meaning of its sign, a distance with its name in pictures and files.
function name_text(q) {
  const w = words(), name = w.names[QUANTITIES[q]], sense = recording.is_angle(q) ? recording.positive_means[q] : 0;
  if (!recording.is_angle(q)) return w.also_named(name, QUANTITIES[q]);
  return sense ? w.positive(name, sense_text(sense)) : name;
}

// The signs of this config in words, and the units beside those of files.
function signs_text() {
  const w = words(), axis = recording.head.forward_axis, senses = recording.positive_means;
  if (!senses.every((sense) => sense)) return w.units;
  const signs = w.signs(axis, ...senses.map(sense_text));
  return w.sentences(axis.endsWith('Y') ? [signs, w.signs_y(axis), w.units] : [signs, w.units]);
}

// A number in grey unless its state is valid.
function value_cell(text, state) { return element('td', text, state === VALID ? 'number' : `number not-valid ${STATES[state]}`); }

// The bound of an error, in degrees or m; struck through above the alert limit.
function level_cell(q, level) {
  const is_beyond = Number.isFinite(level) && !(level <= recording.alert(q));
  const cell = element('td', undefined, is_beyond ? 'level beyond' : 'level');
  cell.append(element('span', amount_text(recording, q, level)));
  if (is_beyond) cell.title = words().beyond_limit(amount_text(recording, q, recording.alert(q)));
  return cell;
}

function state_cell(state) { return element('td', words().states[STATES[state]], `state ${STATES[state]}`); }

// Shares of a level as one bar.
function parts_bar(parts) {
  const bar = element('div', undefined, 'bar'), sum = parts.reduce((total, part) => total + (part || 0), 0);
  parts.forEach((part, k) => {
    if (!(part > 0)) return;
    const share = element('i');
    share.style.width = `${100 * part / sum}%`;
    share.style.background = `var(--part-${recording.words.parts[k]})`;
    share.title = `${part_text(k)} ${percent(part / sum)}`;
    bar.append(share);
  });
  const cell = element('td');
  cell.append(bar);
  return cell;
}

// rows: of a quantity its level, the level of raw, the parts (degrees or m) and the part that is mostly the largest.
function parts_table(rows) {
  const w = words(), kinds = recording.words.parts;
  const out = table(['', w.of_value, w.of_raw, w.shares].concat(kinds.map((_, k) => part_text(k)), [w.mostly]), rows.map((x) => {
    const cells = [name_text(x.q), level_cell(x.q, x.level), level_cell(x.q, x.raw_level), parts_bar(x.parts)];
    x.parts.forEach((part, k) => cells.push(element('td', amount_text(recording, x.q, part), k === x.cause ? 'largest' : undefined)));
    return cells.concat([element('td', x.mostly, 'words')]);
  }));
  out.querySelectorAll('th').forEach((cell, i) => {
    if (i < 4 || i >= 4 + kinds.length) return;
    const mark = element('i', undefined, 'mark');
    mark.style.background = `var(--part-${kinds[i - 4]})`;
    cell.prepend(mark);
  });
  return out;
}

function show_levels(f) {
  const rows = QUANTITIES.map((name, q) => {
    const i = recording.at(f, q), unit = recording.unit(q);
    return { q, level: recording.bound_of(f, q), raw_level: recording.raw_level[i] * unit, cause: recording.cause[i],
      parts: recording.parts(f, q).map((part) => part * unit), mostly: recording.has_level(f, q) ? part_text(recording.cause[i]) : '–' };
  });
  fill('levels', element('h3', words().made_of), parts_table(rows));
}

// Smoothing and holding are no reason bits: the level of the value accounts for them.
function why_text(f, q) {
  const w = words(), i = recording.at(f, q), why = recording.reason_bits(recording.reasons[i]).map(reason_text);
  if (recording.differs(f, q)) why.push(w.lag_why(amount_text(recording, q, Math.abs(recording.value[i] - recording.raw[i]) * recording.unit(q))));
  else if (recording.words.parts[recording.cause[i]] === 'lag') why.push(w.lag_largest);
  if (recording.state[i] === HELD) why.push(w.held_why(number_text(recording.age_s[i], 1)));
  return w.joined(why);
}

function show_values(f) {
  const w = words(), head = ['', w.state, w.value, w.level, w.raw, w.raw_level, w.sigma, w.age];
  if (recording.has_truth) head.push(w.truth, w.error);
  fill('values', table(head.concat([w.why]), QUANTITIES.map((name, q) => {
    const i = recording.at(f, q), unit = recording.unit(q), state = recording.state[i], amount = (x) => amount_text(recording, q, x * unit);
    const is_there = state !== INVALID;
    const cells = [name_text(q), state_cell(state), value_cell(is_there ? amount(recording.value[i]) : '–', state), level_cell(q, recording.bound_of(f, q)),
      value_cell(amount(recording.raw[i]), state), level_cell(q, recording.raw_level[i] * unit), amount(recording.sigma[i]),
      `${number_text(recording.age_s[i], 1)} s`];
    if (recording.has_truth) cells.push(amount(recording.truth[i]), is_there ? amount_text(recording, q, recording.error_of(f, q)) : '–');
    return cells.concat([element('td', why_text(f, q), 'words')]);
  })));
  document.getElementById('signs').textContent = w.sentences([w.act_only, signs_text()]);
}

// How the picture and the table of this frame belong together.
function drawn_text(f) {
  const w = words(), differ = [], held = [], invalid = [], lines = [];
  QUANTITIES.forEach((name, q) => {
    const i = recording.at(f, q), amount = (x) => amount_text(recording, q, x * recording.unit(q));
    if (recording.differs(f, q)) differ.push(w.differ_one(w.names[name], amount(recording.raw[i]), amount(recording.value[i])));
    if (recording.state[i] === HELD) held.push(w.held_one(w.names[name], amount(recording.value[i]), number_text(recording.age_s[i], 1)));
    if (recording.state[i] === INVALID) invalid.push(w.names[name]);
  });
  if (differ.length) lines.push(w.differ(differ));
  else if (QUANTITIES.some((_, q) => Number.isFinite(recording.raw[recording.at(f, q)]))) lines.push(w.agree);
  if (held.length) lines.push(w.held_now(held));
  if (invalid.length) lines.push(w.invalid_now(invalid));
  if (!recording.floor[3 * f + 2] && !recording.error[f]) lines.push(w.no_yaw);
  else if (recording.state[recording.at(f, YAW)] === INVALID) lines.push(w.old_yaw);
  return w.sentences(lines);
}

function show_layers() {
  const w = words(), box = (text, style, checked, change) => {
    const out = element('label'), input = element('input'), mark = element('i');
    input.type = 'checkbox';
    input.checked = checked;
    input.addEventListener('change', () => { change(input.checked); viewer.draw(page.frame); });
    mark.style.background = `var(--${style})`;
    out.append(input, mark, text);
    return out;
  };
  fill('layers', ...LAYERS.map((name, k) => box(w.layers[k], name, viewer.shown[k], (on) => { viewer.shown[k] = on; })),
    box(w.planes, 'ink', viewer.planes_shown, (on) => { viewer.planes_shown = on; }),
    box(w.boxes, 'dropped', viewer.boxes_shown, (on) => { viewer.boxes_shown = on; }));
}
