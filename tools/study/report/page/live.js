// The live page: frames come one by one as events; the last ones are kept for the trends.

// A recording whose frames come one by one. When its room is full the older half goes.
class LiveRecording extends Recording {
  constructor(hello, first, number) {
    super({ ...first, head: hello.head, words: hello.words });
    this.room = LiveRecording.kRoom;
    this.is_live = true;
    this.points_frame = 0;
    this.numbers = [number];
    for (const name of LiveRecording.kSeries) {
      const one = this[name];
      this[name] = new one.constructor(this.room * one.length);
      this[name].set(one);
      this[`${name}_width`] = one.length;
    }
  }

  append(data, number) {
    if (this.frames === this.room) {
      const kept = this.room / 2;
      for (const name of LiveRecording.kSeries) this[name].copyWithin(0, (this.frames - kept) * this[`${name}_width`]);
      this.frames = kept;
      this.points_frame -= this.room - kept;
      this.source = this.source.slice(-kept);
      this.numbers = this.numbers.slice(-kept);
      this.error = this.error.slice(-kept);
    }
    const one = new Recording({ ...data, head: this.head, words: this.words });
    for (const name of LiveRecording.kSeries) this[name].set(one[name], this.frames * this[`${name}_width`]);
    this.source.push(data.source[0]);
    this.numbers.push(number);
    this.error.push(data.error[0]);
    this.positive_means = one.positive_means;
    if (one.point_label.length) Object.assign(this, { point_cm: one.point_cm, point_label: one.point_label, points_frame: this.frames });
    ++this.frames;
  }

  number_of(frame) { return this.numbers[frame]; }

  // One cloud is kept, the newest.
  cloud_at() { return this.point_label.length ? 0 : -1; }
  cloud_range() { return [0, this.point_label.length]; }
  // What has gone with the older half stood as the first frame that is left.
  frame_of_cloud() { return Math.max(0, this.points_frame); }
}
LiveRecording.kRoom = 6000;  // five minutes at 10 Hz stay when the older half goes
LiveRecording.kSeries = ['value', 'raw', 'sigma', 'level', 'raw_level', 'part', 'age_s', 'truth', 'engine_ms', 'confidence', 'planes', 'floor', 'machine',
  'stage_ms', 'reasons', 'frame_reasons', 'counts', 'state', 'cause', 'steer', 'stamp_s'];

// Silence of a sensor is told ten times a second: so long without a result is a break, or a worker that hangs. Health comes
// from the server, whatever the worker does, and makes nothing current.
const kLost_ms = 1000, kChartsEvery_ms = 400;
const page = { language: 'en', frame: 0, paused: false, hello: null, told: null, heard_ms: 0, arrivals: [], drawn_charts_ms: 0, shown: 0, spoken: '' };
let commission = null, recording = null, viewer = null, charts = null, roadway = null;

function put(id, text) {
  const node = document.getElementById(id);
  if (node.textContent !== text) node.textContent = text;
}

const kWorst = ['good', 'fair', 'bad'];
function worse(...grades) { return kWorst[Math.max(...grades.map((grade) => kWorst.indexOf(grade)))]; }

// What may steer is told of the newest frame, also while the picture stands still. It is no greener than the stop.
function show_steer(link_grade) {
  const is_lost = link_grade === 'lost' || !recording;
  const list = is_lost ? [] : steering_of(recording.frames - 1);
  const { may, may_not, help } = is_lost ? { may: words().nothing_current, may_not: '', help: '' } : steer_sentences(list);
  put('steer-may', may);
  put('steer-not', may_not);
  put('steer-help', help);
  const grade = is_lost ? (link_grade === 'lost' ? 'bad' : 'fair') : worse(link_grade, steer_grade(list), roadway ? roadway.grade() : 'good');
  document.getElementById('steer').className = `panel ${grade}`;
  return { grade, may };
}

// Those who hear the page are told when the grade, the link or the stop changes, and not each number.
function speak({ grade, may }, link_grade, link) {
  const stop = roadway ? roadway.spoken() : '', is_silent = page.told && page.told.told_by === 'silence';
  const key = [page.language, grade, link_grade, page.paused, is_silent, stop].join(' ');
  if (key === page.spoken) return;
  page.spoken = key;
  put('spoken', words().sentences([may, link, stop].filter((text) => text)));
}

// Of a silence: what has become of the values.
function silence_text(age_s) {
  const w = words(), f = recording ? recording.frames - 1 : 0, of = (is_so) => QUANTITIES.some((_, q) => is_so(recording.at(f, q)));
  if (recording && of((i) => recording.state[i] !== INVALID)) return w.silent(age_s);
  return recording && of((i) => recording.age_s[i] > 0) ? w.silent_invalid(age_s) : w.silent_never(age_s);
}

function show_link() {
  const w = words(), now = performance.now();
  const away_s = Math.round((now - page.heard_ms) / 1000);
  const is_lost = now - page.heard_ms > kLost_ms;
  document.body.classList.toggle('waiting', is_lost || !recording);
  document.body.classList.toggle('paused', page.paused && !is_lost);
  const say = (grade, text) => { put('link', text); speak(show_steer(grade), grade, text); };
  if (!page.heard_ms) return say('fair', w.no_link_yet);
  if (is_lost) return say('lost', w.no_link(away_s));
  if (page.paused) return say('fair', w.paused);
  if (!page.told) return say('fair', w.no_link_yet);
  if (page.told.told_by === 'silence') return say('bad', silence_text((page.told.age_ms / 1000).toFixed(1)));
  const span_ms = page.arrivals.length > 1 ? page.arrivals[page.arrivals.length - 1] - page.arrivals[0] : NaN;
  return say('good', w.live({ frame: page.told.frame, rate: number_text(1000 * (page.arrivals.length - 1) / span_ms, 1), age: number_text(page.told.age_ms, 0) }));
}

// Of what may not steer the one cause that the first line tells, and the limit where the level is beyond it.
function tile_why(f, q) {
  if (may_steer(f, q)) return why_text(f, q);
  const cause = steer_text(recording.steer[recording.at(f, q)]), limit = recording.alert(q);
  return recording.bound_of(f, q) > limit ? words().beyond_why(amount_text(recording, q, limit), cause) : cause;
}

function show_tiles(f) {
  const w = words();
  fill('tiles', ...QUANTITIES.map((name, q) => {
    const i = recording.at(f, q), state = STATES[recording.state[i]], tile = element('div', undefined, `tile ${state}`);
    const digits = recording.is_angle(q) ? 2 : 3, unit = recording.is_angle(q) ? '°' : ' m', factor = recording.unit(q);
    const known = state !== 'invalid' && Number.isFinite(recording.value[i]);
    const rounded = fixed(recording.value[i] * factor, digits);
    const number = element('div', known ? rounded + unit : '–', 'number');
    if (known) {
      const is_beyond = !(recording.level[i] * factor <= recording.alert(q)), level = `${(recording.level[i] * factor).toFixed(digits)}${unit}`;
      number.append(element('small', w.at_most(level), is_beyond ? 'level beyond' : 'level'));
    }
    const age = recording.age_s[i] > 0 ? `, ${number_text(recording.age_s[i], 1)} s` : '';
    tile.append(element('div', name_text(q), 'name'), number, element('div', w.states[state] + age, `state ${state}`), element('div', tile_why(f, q), 'why'));
    return tile;
  }));
}

function show_mount() {
  const w = words(), at = (p, digits) => p.map((v) => v.toFixed(digits)).join(', '), m = page.hello.mount, rows = [];
  const axis = (v) => `${v[0] < 0 || v[1] < 0 ? '-' : '+'}${v[0] ? 'X' : 'Y'}`;
  rows.push([w.forward, axis(recording.head.machine.forward)], [w.left_axis, axis(recording.head.machine.left)]);
  rows.push([w.sensor_at, `${at(m.position_m, 3)} m`], [w.sensor_turned, `${w.names.roll}, ${w.names.pitch}, ${w.names.yaw} ${at(m.roll_pitch_yaw_deg, 2)}°`]);
  m.sampling_points_m.forEach((p, k) => rows.push([`${w.sampling} ${w.names[QUANTITIES[3 + k]]}`, `${at(p, 3)} m`]));
  recording.head.body_boxes.forEach((b, k) => rows.push([`${w.box} ${k + 1}`,
    `x ${b[0].toFixed(2)} … ${b[1].toFixed(2)}, y ${b[2].toFixed(2)} … ${b[3].toFixed(2)}, z ${b[4].toFixed(2)} … ${b[5].toFixed(2)} m`]));
  if (!recording.head.body_boxes.length) rows.push([w.box, w.none]);
  fill('mount', table([w.what, w.where], rows));
}

// The daemon tells each part in English, and in Chinese beside (`zh`).
function show_health(parts) {
  const w = words();
  page.parts = parts;
  fill('health', table([w.part, w.grade, w.summary_of, w.facts], parts.map((part) => {
    const told = page.language === 'zh' ? part.zh : part;
    return [told.part, element('td', w.grades[part.grade], `grade ${part.grade}`), told.summary,
      element('td', Object.entries(told.facts).map(([name, value]) => `${w.names[name] || name} ${w.states[value] || value}`).join(' · '), 'facts')];
  })));
}

function show_settings() {
  const w = words(), rows = recording.head.settings;
  fill('settings', rows.length ? table([w.key, w.set_to, w.default_is], rows) : element('p', w.all_default, 'faint'));
}

// The tiles and the picture are drawn with every frame, the rest a few times a second.
function show_frame() {
  const f = page.frame = recording.frames - 1, w = words();
  show_tiles(f);
  if (roadway) viewer.space.sweep = roadway.sweep(recording.head.machine.forward);
  viewer.is_old = page.told.told_by === 'silence';
  viewer.draw(f);
  document.getElementById('drawn-note').textContent = w.sentences([viewer.is_old && recording.cloud_at(f) >= 0 ? w.old_points(number_text(page.told.age_ms / 1000, 1)) : '',
    drawn_text(f)].filter((text) => text));
  const notes = [w.counts(recording.counts.subarray(10 * f, 10 * f + 10))];
  for (const bit of recording.reason_bits(recording.frame_reasons[f])) notes.push(reason_text(bit));
  document.getElementById('frame-note').textContent = notes.join(' · ');
  ++page.shown;
  if (performance.now() - page.drawn_charts_ms > kChartsEvery_ms) show_slowly();
}

function show_slowly() {
  page.drawn_charts_ms = performance.now();
  const f = recording.frames - 1;
  charts.ranges = QUANTITIES.map((_, q) => charts.range_of(q));
  charts.show(Math.max(0, f - LiveRecording.kRoom / 2), f);
  show_values(f);
  show_levels(f);
}

function show_all() {
  const w = words();
  document.documentElement.lang = page.language;
  document.title = w.live_title;
  document.querySelectorAll('[data-word]').forEach((node) => { node.textContent = w[node.dataset.word]; });
  document.getElementById('language').textContent = w.other_language;
  document.getElementById('theme').textContent = w.theme;
  document.getElementById('pause').textContent = page.paused ? w.resume_live : w.pause_live;
  show_link();
  show_hints();
  if (commission) { commission.tell_anew(); commission.show(); }
  if (!recording) return;
  document.getElementById('subtitle').textContent = recording.head.title;
  show_layers();
  show_mount();
  show_settings();
  if (page.parts) show_health(page.parts);
  show_frame();
  show_slowly();
}

function take_frame(event) {
  const told = JSON.parse(event.data);
  page.told = told;
  page.heard_ms = performance.now();
  if (told.told_by === 'frame') {
    page.arrivals.push(page.heard_ms);
    if (page.arrivals.length > 20) page.arrivals.shift();
  }
  if (!page.hello) return;
  const is_first = !recording;
  if (is_first) {
    recording = new LiveRecording(page.hello, told.data, told.frame);
    viewer = new Viewer(recording);
    charts = new Charts(recording, document.getElementById('charts'), () => {});
    add_savers();
    show_all();
  } else {
    recording.append(told.data, told.frame);
  }
  // Frames that came together are drawn once.
  if (!page.paused && !page.drawing) {
    page.drawing = true;
    requestAnimationFrame(() => { page.drawing = false; show_frame(); show_link(); });
  }
}

function take_hello(event) {
  page.hello = JSON.parse(event.data);
  if (page.hello.commissioning && !commission) commission = new CommissionPanel();
  if (page.hello.planar && !roadway) roadway = new RoadwayView(page.hello.planar);
  if (page.hello.planar) roadway.planar = page.hello.planar;  // of a restart with other settings
  if (!recording) return;
  Object.assign(recording, { head: page.hello.head, words: page.hello.words });
  show_all();
}

function connect() {
  const events = new EventSource('/events');
  events.addEventListener('hello', take_hello);
  events.addEventListener('frame', take_frame);
  events.addEventListener('health', (event) => {
    if (!page.paused) show_health(JSON.parse(event.data).parts);
  });
  const of_roadway = (name, take) => events.addEventListener(name, (event) => { if (roadway) take(JSON.parse(event.data)); });
  of_roadway('map', (map) => { if (!page.paused) roadway.take_map(map); });
  of_roadway('roadway', (place) => { if (!page.paused) roadway.take_place(place); });
  of_roadway('stop', (stop) => roadway.take_stop(stop));
  // A daemon that is being started anew refuses; then the browser gives up unless it is asked again.
  events.onerror = () => {
    if (events.readyState !== EventSource.CLOSED) return;
    events.close();
    setTimeout(connect, 1000);
  };
}

document.getElementById('language').addEventListener('click', () => { page.language = page.language === 'en' ? 'zh' : 'en'; show_all(); });
document.getElementById('pause').addEventListener('click', () => { page.paused = !page.paused; show_all(); });
window.addEventListener('resize', () => { if (recording) { viewer.draw(page.frame); charts.draw(); } });
setInterval(show_link, 250);
setInterval(() => { if (roadway) roadway.show(); }, 100);
page.language = (navigator.language || 'en').startsWith('zh') ? 'zh' : 'en';
follow_theme(() => {
  if (recording) { viewer.draw(page.frame); charts.draw(); }
  if (roadway) roadway.draw();
});
show_all();
connect();
