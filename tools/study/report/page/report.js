// Puts the page together and reacts to the reader.

const page = { language: 'en', frame: 0, timer: null };

function shares_text() {
  const { usable_share, in_part_share } = recording.head;
  return { usable: whole_percent(usable_share), in_part: whole_percent(in_part_share) };
}

function show_verdict() {
  const w = words(), headline = w[summary.headline];
  const use = (x) => use_of(x.valid, recording.head);
  const named = (is_meant) => summary.quantities.filter(is_meant).map((x) => w.names[x.name]);
  const facts = { ...shares_text(), some: named((x) => use(x) !== 'not_usable'), none: named((x) => use(x) === 'not_usable') };
  const lines = [], say = (text, name) => lines.push(element('p', text, name));
  if (summary.readable.length) {
    const { may, may_not, help } = steer_sentences(summary.quantities.map((x) => ({ ...x.steer, may: use(x) === 'usable' })));
    say(may);
    if (may_not) say(may_not);
    if (help) say(help);
  }
  say(typeof headline === 'function' ? headline(facts) : headline, 'headline');
  if (recording.head.from_table) say(w.from_table);
  if (!recording.head.complete) say(w.interrupted(recording));
  if (summary.unreadable) say(w.verdict_unreadable(summary.unreadable));
  const name_those = (text, is_meant) => {
    const names = named(is_meant);
    if (names.length && summary.readable.length) say(text(names, facts));
  };
  name_those(w.verdict_never, (x) => !(x.valid > 0));
  name_those(w.verdict_mostly_not, (x) => use(x) === 'not_usable' && x.valid > 0);
  if (summary.headline === 'verdict_fair') {
    name_those(w.verdict_in_part, (x) => use(x) === 'in_part');
    name_those(w.verdict_can_use, (x) => use(x) === 'usable');
  }
  if (!recording.has_truth) say(w.verdict_no_truth);
  else {
    say(summary.misleading ? w.verdict_misleading(summary.misleading) : w.verdict_no_misleading(summary.valid));
    if (summary.beyond) say(w.verdict_beyond(summary.beyond));
  }
  const share = (n) => percent(n / Math.max(1, summary.readable.length));
  for (const x of summary.quantities) {
    if (use(x) === 'usable') continue;
    const shares = [3, 2, 1, 0].filter((state) => state === VALID || x.states[state]).map((state) => w.state_share(w.states[STATES[state]], share(x.states[state])));
    say(w.verdict_value({ name: w.names[x.name], shares,
      level: amount_text(recording, x.q, x.level), limit: amount_text(recording, x.q, recording.alert(x.q)),
      why: x.reasons.length ? reason_text(x.reasons[0][0]) : '' }), 'detail');
  }
  say(w.verdict_rule(shares_text()), 'faint');
  fill('verdict', ...lines);
  document.getElementById('verdict').className = `panel ${summary.grade}`;
}

function show_summary() {
  const w = words(), share = (n) => percent(n / Math.max(1, summary.readable.length));
  const head = ['', w.use, w.states.valid, w.states.degraded, w.states.held, w.states.invalid, w.median, w.median_level];
  if (recording.has_truth) head.push(w.rmse, w.max_error, w.beyond, w.misleading);
  fill('summary', table(head, summary.quantities.map((x) => {
    const use = use_of(x.valid, recording.head);
    const cells = [name_text(x.q), element('td', w.uses[use], `use ${use}`), share(x.states[3]), share(x.states[2]), share(x.states[1]), share(x.states[0]),
      element('td', amount_text(recording, x.q, x.median), use === 'not_usable' ? 'number not-valid' : 'number'), level_cell(x.q, x.level)];
    if (recording.has_truth) cells.push(amount_text(recording, x.q, x.rmse), amount_text(recording, x.q, x.largest), String(x.beyond), String(x.misleading));
    return cells;
  })));
  const rows = [];
  for (const x of summary.quantities) {
    for (const [bit, frames] of x.reasons.slice(0, 3)) rows.push([w.names[x.name], element('td', reason_text(bit), 'words'), String(frames)]);
  }
  fill('reasons', element('h2', w.reasons), table(['', w.reason, w.frames_with], rows));
  show_level_parts();
  show_times();
}

function show_level_parts() {
  const w = words();
  if (!has_parts()) {
    fill('level-parts', element('p', w.no_parts, 'faint'));
    return;
  }
  fill('level-parts', element('h2', w.made_of_median), parts_table(summary.quantities.map((x) => ({ ...x.made_of,
    mostly: x.made_of.often > 0 ? w.mostly_often(part_text(x.made_of.cause), percent(x.made_of.often)) : '–' }))));
}

// A table of run has them with --parts.
function has_parts() { return recording.part.some(Number.isFinite); }

function show_times() {
  const w = words(), of = (numbers) => [0.5, 0.99, 1].map((share) => `${number_text(quantile(numbers, share), 2)} ms`);
  const rows = [[w.engine, ...of(recording.engine_ms)]], stages = recording.words.stages;
  stages.forEach((_, k) => {
    rows.push([`${w.stage} ${stage_text(k)}`, ...of(summary.readable.map((f) => recording.stage_ms[stages.length * f + k]))]);
  });
  const stamps = stamp_health(recording);
  rows.push([w.rate, number_text(stamps.rate, 2), '', ''], [w.gaps, String(stamps.gaps), '', '']);
  fill('times', element('h2', w.times), table(['', w.p50, w.p99, w.worst], rows));
}

function show_settings() {
  const w = words(), rows = recording.head.settings;
  fill('settings', rows.length ? table([w.key, w.set_to, w.default_is], rows) : element('p', w.all_default, 'faint'));
}

function show_frame(f) {
  const w = words();
  page.frame = Math.min(Math.max(0, f), recording.frames - 1);
  f = page.frame;
  document.getElementById('slider').value = f;
  document.getElementById('frame-name').textContent = [`${w.frame} ${f}`, moment_text(recording, recording.stamp_s[f], 1), recording.source[f].split('/').pop()].join(' · ');
  const cloud_of = recording.head.from_table ? -1 : viewer.draw(f);
  const { may, may_not } = steer_sentences(steering_of(f));
  document.getElementById('steer-frame').textContent = recording.error[f] ? '' : w.sentences([may, may_not]);
  document.getElementById('drawn-note').textContent = recording.head.from_table ? '' : drawn_text(f);
  show_values(f);
  if (has_parts()) show_levels(f);
  const notes = [recording.error[f] ? `${w.unreadable}: ${recording.error[f]}` : w.counts(recording.counts.subarray(10 * f, 10 * f + 10))];
  for (const bit of recording.reason_bits(recording.frame_reasons[f])) notes.push(reason_text(bit));
  if (cloud_of >= 0 && cloud_of !== f) notes.push(w.no_cloud(cloud_of));
  document.getElementById('frame-note').textContent = notes.join(' · ');
  charts.mark(f);
  timeline.mark(f);
}

function play(on) {
  clearInterval(page.timer);
  page.timer = on ? setInterval(() => {
    if (page.frame + 1 >= recording.frames) play(false); else show_frame(page.frame + 1);
  }, 100) : null;
  document.getElementById('play').textContent = on ? words().pause : words().play;
}

function show_all() {
  show_heading(recording.head.title, words().subtitle(recording));
  play(page.timer !== null);
  if (!recording.head.from_table) show_layers();
  show_verdict();
  show_summary();
  show_settings();
  show_hints();
  compare.show();
  show_frame(page.frame);
}

function listen() {
  listen_to_reader(recording.frames);
  on('play', 'click', () => {
    if (page.timer === null && page.frame + 1 >= recording.frames) show_frame(0);
    play(page.timer === null);
  });
  document.addEventListener('keydown', (event) => {
    if (event.key !== ' ' || ['INPUT', 'BUTTON'].includes(event.target.tagName)) return;
    event.preventDefault();
    play(page.timer === null);
  });
}

const recording = new Recording(JSON.parse(document.getElementById('data').textContent));
const summary = summarise(recording);
const viewer = new Viewer(recording);
const charts = new Charts(recording, document.getElementById('charts'), (f) => show_frame(f));
const timeline = new Timeline(recording, (f) => show_frame(f)), compare = new Compare();
if (recording.head.from_table) for (const figure of document.querySelectorAll('#views figure')) figure.remove();
add_savers();
begin_page(recording.head.language);
listen();
show_all();
