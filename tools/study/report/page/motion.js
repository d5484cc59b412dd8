// Puts the page of a motion table together and reacts to the reader.

const page = { language: 'en', frame: 0 };

function read_motion(data) {
  const float = (name) => new Float32Array(bytesOf(data[name]));
  const motion = { head: data.head, words: data.words, frames: data.frames, source: data.source, truth: data.truth, reason_names: data.reasons.names };
  for (const name of ['place', 'along', 'levels', 'step', 'step_level', 'ms']) motion[name] = float(name);
  motion.stamp_s = new Float64Array(bytesOf(data.stamp_s));
  motion.frame = new Uint32Array(bytesOf(data.frame));
  motion.state = new Uint8Array(bytesOf(data.state));
  motion.reason = new Uint32Array(bytesOf(data.reasons.of_frame));
  motion.true_place = data.truth ? new Float32Array(bytesOf(data.truth.place)) : null;
  return motion;
}

const DIRECTIONS = 6;
function share_text(share) { return Number.isFinite(share) ? `${(100 * share).toFixed(2)} %` : '–'; }
function metres(value) { return Number.isFinite(value) ? `${value.toFixed(3)} m` : '–'; }
function degrees(value) { return Number.isFinite(value) ? `${(value * 180 / Math.PI).toFixed(3)}°` : '–'; }
function of_direction(d, value) { return d < 3 ? metres(value) : degrees(value); }
function level_of(f, d) { return motion.levels[DIRECTIONS * f + d]; }
function reasons_of(f) { return motion.reason_names[motion.reason[f]].split('|').filter((name) => name); }
function said_reason(name) { return (words().reason_texts || motion.words.reason_texts)[name] || name; }

function count_states() {
  const counts = STATES.map(() => 0);
  motion.state.forEach((state) => { ++counts[state]; });
  return counts;
}

function show_verdict() {
  const w = words(), counts = count_states(), measured = counts[3] / Math.max(1, motion.frames);
  const grade = measured >= 0.95 && !counts[0] ? 'good' : measured >= 0.5 ? 'fair' : 'bad';
  const lines = [element('p', w[`verdict_${grade}`])];
  let last = motion.frames - 1;
  while (last >= 0 && !Number.isFinite(motion.along[last])) --last;
  if (last >= 0) {
    const level = level_of(last, 0);
    lines.push(element('p', w.verdict_travel(metres(motion.along[last]), Number.isFinite(level) ? metres(level) : '')));
  }
  for (const state of [2, 1, 0, 4]) if (counts[state]) lines.push(element('p', w.verdict_share(w.states[STATES[state]], percent(counts[state] / motion.frames))));
  if (motion.truth) lines.push(element('p', w.misleading(motion.truth)));
  lines.push(element('p', w.verdict_rule, 'faint'));
  fill('verdict', ...lines);
  document.getElementById('verdict').className = `panel ${grade}`;
}

function show_summary() {
  const w = words(), counts = count_states(), often = new Map();
  fill('summary', table([w.state, w.frames_with, w.share], [3, 2, 1, 0, 4].map((s) => [w.states[STATES[s]], String(counts[s]), percent(counts[s] / Math.max(1, motion.frames))])));
  for (let f = 0; f < motion.frames; ++f) for (const name of reasons_of(f)) often.set(name, (often.get(name) || 0) + 1);
  const rows = [...often].sort((a, b) => b[1] - a[1]).map(([name, n]) => [element('td', said_reason(name), 'words'), String(n)]);
  fill('reasons', element('h2', w.reasons), table([w.reason, w.frames_with], rows));
  show_truth();
}

function show_truth() {
  const w = words(), t = motion.truth;
  if (!t) { fill('truth'); return; }
  const rows = ['along', 'across', 'up'].map((name) => {
    const e = t.error[`${name}_m`];
    return [w.directions[name], metres(e.at_end), metres(e.largest), share_text(t.way_m >= 0.1 ? e.largest / t.way_m : NaN), String(t.pose[name].beyond)];
  });
  rows.push([w.directions.turn, degrees(t.error.turn_rad.at_end), degrees(t.error.turn_rad.largest), '', '']);
  fill('truth', element('h2', w.truth), table([w.error, w.at_end, w.largest, w.of_way, w.beyond], rows), element('p', t.drift.segments ? w.drift(t) : w.no_drift));
}

function show_legend() {
  fill('layers', ...STATES.slice().reverse().map((name) => {
    const out = element('label'), mark = element('i');
    mark.style.background = `var(--${STATE_COLOURS[name]})`;
    out.append(mark, words().states[name]);
    return out;
  }));
}

function show_frame(f) {
  const w = words();
  f = page.frame = Math.min(Math.max(0, f), motion.frames - 1);
  document.getElementById('slider').value = f;
  document.getElementById('frame-name').textContent = `${w.frame} ${motion.frame[f]} · ${motion.source[f].split('/').pop()}`;
  const place = Array.from(motion.place.subarray(3 * f, 3 * f + 3)).map((x) => number_text(x, 3)).join(', ');
  // Grey where the place along the road was not measured; without a place there is no bound.
  const state = motion.state[f], number = (text) => element('td', text, state === MEASURED ? 'number' : 'number not-valid');
  const has_place = Number.isFinite(motion.place[3 * f]), level = (d) => (has_place ? of_direction(d, level_of(f, d)) : '–');
  const rows = [[w.state, element('td', w.states[STATES[state]], `state ${STATE_COLOURS[STATES[state]]}`)], [w.travel, number(number_text(motion.along[f], 4))],
    [w.step, number(number_text(motion.step[f], 4))], [w.place, number(`${place} m`)], [w.time, `${number_text(motion.ms[f], 2)} ms`]];
  motion.words.directions.forEach((name, d) => rows.push([`${w.level}: ${w.directions[name]}`, number(level(d))]));
  const half = Math.ceil(rows.length / 2);
  fill('values', table([w.quantity, w.value, w.quantity, w.value], rows.slice(0, half).map((row, i) => [...row, ...(rows[half + i] || ['', ''])])));
  document.getElementById('frame-note').textContent = reasons_of(f).map(said_reason).join(' · ');
  path.draw(f);
  series.forEach((one) => one.draw(f));
}

function show_all() {
  show_heading(motion.head.title, words().subtitle(motion));
  show_legend();
  show_verdict();
  show_summary();
  show_frame(page.frame);
}

const motion = read_motion(JSON.parse(document.getElementById('data').textContent));
const path = new PathView(document.getElementById('path'), (f) => show_frame(f));
const series = [
  new Series('travel', (f) => motion.along[f], (f) => level_of(f, 0), document.getElementById('charts'), (f) => show_frame(f)),
  new Series('step', (f) => motion.step[f], (f) => motion.step_level[f], document.getElementById('charts'), (f) => show_frame(f)),
];
begin_page(motion.head.language);
listen_to_reader(motion.frames);
show_all();
