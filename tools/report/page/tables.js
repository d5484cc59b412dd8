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

function percent(share) { return `${(100 * share).toFixed(1)} %`; }

function reason_text(bit) {
  const name = recording.words.reason_names[bit];
  return words().reason_texts ? words().reason_texts[name] || name : recording.words.reason_texts[bit];
}

function part_text(part) { return words().parts[recording.words.parts[part]] || recording.words.parts[part]; }

// An angle with what its sign means.
function name_text(q) {
  const w = words(), name = w.names[QUANTITIES[q]], sense = recording.is_angle(q) ? recording.positive_means[q] : 0;
  if (!sense) return name;
  const said = recording.words.senses[sense];
  return w.positive(name, w.senses ? w.senses[said] || said : said);
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

// rows: of a quantity its level, the level of raw, the parts (degrees or m) and which is mostly the largest.
function parts_table(rows) {
  const w = words(), kinds = recording.words.parts;
  const out = table(['', w.of_value, w.of_raw, ''].concat(kinds.map((_, k) => part_text(k)), [w.mostly]), rows.map((x) => {
    const cells = [name_text(x.q), amount_text(recording, x.q, x.level), amount_text(recording, x.q, x.raw_level), parts_bar(x.parts)];
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
    return { q, level: recording.level[i] * unit, raw_level: recording.raw_level[i] * unit, cause: recording.cause[i],
      parts: recording.parts(f, q).map((part) => part * unit), mostly: recording.has_level(f, q) ? part_text(recording.cause[i]) : '–' };
  });
  fill('levels', element('h3', words().made_of), parts_table(rows));
}

// Smoothing is no reason bit: the value is as good as its level says, and later than raw.
function why_text(f, q) {
  const i = recording.at(f, q), why = recording.reason_bits(recording.reasons[i]).map(reason_text);
  if (recording.words.parts[recording.cause[i]] === 'lag') why.push(words().lag_why);
  return why.join('; ');
}

function show_values(f) {
  const w = words(), head = ['', w.value, w.level, w.raw, w.raw_level, w.sigma, w.state, w.age];
  if (recording.has_truth) head.push(w.truth, w.error);
  fill('values', table(head.concat([w.why]), QUANTITIES.map((name, q) => {
    const i = recording.at(f, q), unit = recording.unit(q), amount = (x) => amount_text(recording, q, x * unit);
    const cells = [name_text(q), amount(recording.value[i]), amount(recording.level[i]), amount(recording.raw[i]),
      amount(recording.raw_level[i]), amount(recording.sigma[i]),
      state_cell(recording.state[i]), `${number_text(recording.age_s[i], 1)} s`];
    if (recording.has_truth) cells.push(amount(recording.truth[i]), amount_text(recording, q, recording.error_of(f, q)));
    return cells.concat([element('td', why_text(f, q), 'words')]);
  })));
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
