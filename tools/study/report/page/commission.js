// Commissioning from the page: record, examine, axes and boxes, check, save. The daemon keeps what came of each step; the
// page keeps what a person draws until it is checked. The event `hello` tells whether the key `commissioning` is on; else
// there is no such panel.

const MOUNTING = ['extrinsic_x', 'extrinsic_y', 'extrinsic_z', 'extrinsic_roll', 'extrinsic_pitch', 'extrinsic_yaw'], BOXES_MOST = 4;
const OF_THE_DRAFT = ['ahead', 'mounting', 'boxes'];  // what is confirmed where it is drawn; the rest where it is saved
const kDegPerRad = 180 / Math.PI;

class CommissionPanel {
  constructor() {
    Object.assign(this, { state: null, draft: null, asked: null, refused: '', told_error: '', language: page.language, scene: null, confirmed: {}, shown: '' });
    this.panel = document.getElementById('commission');
    this.canvas = element('canvas');  // stays, and so do its view and its context
    this.canvas.id = 'commission-space';
    this.look();
  }

  async look() {
    const answer = await fetch('/commissioning.json').catch(() => null);
    if (answer && answer.ok) this.take(await answer.json());
    setTimeout(() => this.look(), this.state && this.state.open ? 1000 : 5000);
  }

  // is_retold: the same in another language.
  async ask(step, message, is_retold = false) {
    Object.assign(this, { asked: step, told_error: '' });
    const answer = await fetch(`/commissioning/${step}`, { method: 'POST', headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify({ language: page.language, ...message }) }).catch(() => null);
    if (step === 'examine' && answer && answer.ok && !is_retold) this.proposed = '';
    this.refused = answer && !answer.ok ? (await answer.json().catch(() => ({ error: answer.status }))).error : '';
    const now = await fetch('/commissioning.json').catch(() => null);
    if (now && now.ok) this.take(await now.json());
  }

  // What the doctor proposes is taken into the draft once.
  take(state) {
    this.state = state;
    if (!state.open || !state.recorded) this.proposed = '';
    if (state.open && !this.draft) this.draft = this.draft_of(state.mounting);
    if (state.open && JSON.stringify(state.recorded) !== this.recorded) this.begin_anew();
    if (state.open && state.examined && state.examined.grade !== 'not') this.take_proposal(state.examined.changes);
    this.show();
  }

  // What was proposed and confirmed was of another recording.
  begin_anew() {
    if (this.recorded !== undefined) this.draft = this.draft_of(this.state.mounting);
    Object.assign(this, { recorded: JSON.stringify(this.state.recorded), confirmed: {} });
  }

  // The same proposal in other words leaves what a person drew since.
  take_proposal(changes) {
    const values = JSON.stringify(changes.map(({ key, value }) => [key, value]));
    if (values !== this.proposed) this.propose(changes);
    this.proposed = values;
    for (const gate of this.draft.gates) Object.assign(gate, { reason: changes.find(({ key }) => key === gate.key).reason });
  }

  // What the command told is in the language in which it was asked. Asked again it costs nothing that a person did, until
  // the settings are saved.
  tell_anew() {
    const s = this.state;
    if (this.language === page.language) return;
    this.language = page.language;
    if (!s || !s.open || s.busy || s.saved) return;
    if (s.checked) this.ask('check', { changes: s.checked.changes }, true);
    else if (s.examined) this.ask('examine', {}, true);
  }

  draft_of(mounting) {
    const value = Object.fromEntries(mounting.map(({ key, value: text }) => [key, text]));
    const boxes = Array.from({ length: BOXES_MOST }, (_, k) => numbers_of(value[`body_box_${k + 1}`])).filter((box) => box.length === 6);
    return { axis: value.forward_axis, mounting: MOUNTING.map((key) => Number(value[key])), boxes, gates: [] };
  }

  propose(changes) {
    const { draft } = this;
    draft.gates = [];
    for (const { key, before, value, reason } of changes) {
      if (key === 'forward_axis') draft.axis = value;
      else if (MOUNTING.includes(key)) draft.mounting[MOUNTING.indexOf(key)] = Number(value);
      else if (key.startsWith('body_box_')) draft.boxes[Number(key.slice(9)) - 1] = numbers_of(value); // the others stay
      else draft.gates.push({ key, before, value, reason, is_taken: true });
    }
    draft.boxes = draft.boxes.filter((box) => box && box.length === 6).slice(0, BOXES_MOST);
    this.confirmed = {};
  }

  // All that differs from what the daemon measures with now.
  changes() {
    const now = Object.fromEntries(this.state.mounting.map(({ key, value }) => [key, value])), { draft } = this, changes = {};
    if (draft.axis !== now.forward_axis) changes.forward_axis = draft.axis;
    MOUNTING.forEach((key, k) => { if (draft.mounting[k] !== Number(now[key])) changes[key] = String(Number(draft.mounting[k].toFixed(6))); });
    for (let k = 0; k < BOXES_MOST; ++k) {
      const key = `body_box_${k + 1}`, box = (draft.boxes[k] || []).map((v) => Number(v.toFixed(3)));
      if (box.join() !== numbers_of(now[key]).join()) changes[key] = box.join(' ');
    }
    for (const gate of draft.gates) if (gate.is_taken) changes[gate.key] = gate.value;
    return changes;
  }

  is_checked() {
    const { checked } = this.state;
    return Boolean(checked) && same_members(checked.changes, this.changes());
  }

  // Who types is not disturbed: what is the same as before is not made anew.
  show() {
    const s = this.state;
    if (!s) return;
    this.panel.hidden = false;
    const busy = this.panel.querySelector('.commission-busy');
    if (busy && s.busy) busy.textContent = this.busy_text();
    const what = JSON.stringify([page.language, this.refused, this.asked, { ...s, busy_s: 0, clouds: 0 }, this.draft && this.draft.gates.length, this.draft && this.draft.boxes.length]);
    if (what === this.shown) return;
    this.shown = what;
    const w = words(), parts = [element('h2', w.commission), element('p', w.commission_on, 'faint')];
    // What was asked before the page was loaded has no button that it belongs to.
    if (s.error && (!this.asked || this.asked === 'open')) parts.push(this.error_line(s.error));
    parts.push(...(s.open ? this.steps() : [this.code()]));
    this.panel.replaceChildren(...parts);
    if (s.open && s.examined) this.show_space();
    this.show_error();
  }

  error_text(text) { return (words().commission_errors || {})[text] || String(text); }

  error_line(text) {
    const out = element('span', this.error_text(text), 'commission-error');
    out.setAttribute('role', 'alert');
    return out;
  }

  // Why a step was refused or failed, for beside its button.
  error_of(step) {
    const text = this.refused || this.state.error;
    return text && this.asked === step ? [this.error_line(text)] : [];
  }

  // Once each: it is brought to where the reader looks.
  show_error() {
    const line = this.panel.querySelector('[role=alert]'), text = line ? line.textContent : '';
    // Not at an edge: what stands above grows from frame to frame.
    if (line && text !== this.told_error) line.scrollIntoView({ block: 'center' });
    this.told_error = text;
  }

  code() {
    const w = words(), form = element('form', undefined, 'commission-row'), input = element('input');
    Object.assign(input, { id: 'commission-code', autocomplete: 'off', spellcheck: false, placeholder: 'XXXXX-XXXXX', maxLength: 20 });
    input.setAttribute('aria-label', w.commission_code);
    const go = button(w.commission_open, () => {});
    go.type = 'submit';
    form.append(element('span', w.commission_code), input, go, ...this.error_of('open'));
    input.value = this.typed || '';  // a wrong letter does not cost the other nine
    input.addEventListener('input', () => { this.typed = input.value; });
    form.addEventListener('submit', (event) => { event.preventDefault(); this.ask('open', { code: input.value.normalize('NFKC') }); });
    return form;
  }

  steps() {
    const s = this.state, w = words();
    const bodies = [this.record(), s.recorded && this.examine(), s.examined && this.draw(), s.examined && this.check(), s.checked && this.save()];
    return bodies.map((body, k) => {
      const step = element('div', undefined, 'commission-step');
      step.append(element('h3', w.commission_steps[k]), ...(body || []));
      step.classList.toggle('later', !body);
      return step;
    });
  }

  busy_text() { return words().commission_busy(words().commission_jobs[this.state.busy], this.state.busy_s); }

  // A step's button and why it was refused, or how long it has been at work.
  action(step, text, message) {
    const s = this.state;
    if (s.busy === step) return [element('span', this.busy_text(), 'commission-busy')];
    const out = button(text, () => this.ask(step, message ? message() : {}));
    out.disabled = Boolean(s.busy);
    return [out, ...this.error_of(step)];
  }

  record() {
    const w = words(), row = element('p', undefined, 'commission-row');
    row.append(...this.action('record', w.commission_record, () => ({ seconds: 30 })));
    if (this.state.recorded) row.append(element('span', w.commission_recorded(this.state.recorded)));
    return [element('p', w.commission_record_help), row];
  }

  examine() {
    const w = words(), found = this.state.examined, row = element('p', undefined, 'commission-row');
    row.append(...this.action('examine', w.commission_examine));
    const out = [element('p', w.commission_examine_help), row];
    if (!found) return out;
    const list = element('ul');
    for (const text of [...found.but, ...found.confirm]) list.append(element('li', text));
    out.push(element('p', `${w.commission_grades[found.grade] || found.grade}: ${found.because}`, `use ${found.grade}`), list);
    if (this.draft.gates.length) out.push(this.gates());
    return out;
  }

  gates() {
    const w = words(), box = element('div', undefined, 'wide');
    box.append(table([w.commission_take, w.commission_key, w.commission_before, w.commission_proposed, w.commission_reason], this.draft.gates.map((gate) => {
      const taken = check_box(gate.is_taken, (is_taken) => { gate.is_taken = is_taken; this.note_change(); });
      taken.setAttribute('aria-label', gate.key);
      const cell = element('td');
      cell.append(taken);
      return [cell, gate.key, gate.before, gate.value, element('td', gate.reason, 'words')];
    })));
    return box;
  }

  draw() {
    const w = words(), axes = element('p', `${w.commission_axis}: `, 'commission-row'), mounting = element('p', `${w.commission_mounting}: `, 'commission-row');
    for (const axis of ['+X', '-X', '+Y', '-Y']) {
      const choice = button(axis, () => { this.draft.axis = axis; Object.assign(this.confirmed, { ahead: false, ahead_otherwise: false }); this.note_change(true); });
      choice.setAttribute('aria-pressed', String(this.draft.axis === axis));
      axes.append(choice);
    }
    MOUNTING.forEach((key, k) => {
      const factor = k < 3 ? 1 : kDegPerRad, unit = k < 3 ? ' m' : '°';
      mounting.append(number_field(w.names[key.slice(10)] || key.slice(10), unit, this.draft.mounting[k] * factor, k < 3 ? 3 : 2, (v) => { this.draft.mounting[k] = v / factor; this.confirmed.mounting = false; this.note_change(); }));
    });
    this.space_note = element('p', w.commission_space_help, 'faint');
    const drawn = this.confirmations(this.state.to_confirm.filter((name) => OF_THE_DRAFT.includes(name)));
    return [this.canvas, this.space_note, axes, mounting, ...this.draft.boxes.map((_, k) => this.box_row(k)), this.add_row(), drawn];
  }

  confirmations(names) {
    const all = element('p', undefined, 'commission-confirm');
    for (const name of names) {
      const label = element('label');
      const box = check_box(this.confirmed[name], (is_so) => { this.confirmed[name] = is_so; });
      box.dataset.confirms = name;
      label.append(box, ` ${words().commission_confirm[name]}`);
      all.append(label);
    }
    return all;
  }

  box_row(k) {
    const w = words(), row = element('p', undefined, 'commission-row commission-box');
    row.append(element('b', w.commission_box(k + 1)));
    w.commission_edges.forEach((name, i) => row.append(number_field(name, ' m', this.draft.boxes[k][i], 2, (v) => { this.draft.boxes[k][i] = v; this.confirmed.boxes = false; this.note_change(); })));
    row.append(button(w.commission_remove, () => { this.draft.boxes.splice(k, 1); this.confirmed.boxes = false; this.note_change(true); }));
    return row;
  }

  add_row() {
    const row = element('p', undefined, 'commission-row');
    const add = button(words().commission_add, () => { this.draft.boxes.push([-0.5, 0.5, -0.5, 0.5, -0.5, 0.5]); this.confirmed.boxes = false; this.note_change(true); });
    add.disabled = this.draft.boxes.length >= BOXES_MOST;
    row.append(add);
    return row;
  }

  check() {
    const w = words(), { checked } = this.state, row = element('p', undefined, 'commission-row');
    row.append(...this.action('check', w.commission_check, () => ({ changes: this.changes() })));
    const out = [element('p', w.commission_check_help), row];
    if (!checked) return out;
    if (!this.is_checked()) out.push(element('p', w.commission_changed, 'commission-error'));
    out.push(element('pre', checked.told.join('\n')), link(w.commission_report, '/commissioning/report.html'));
    return out;
  }

  save() {
    const w = words(), s = this.state, row = element('p', undefined, 'commission-row'), by = element('input');
    by.value = this.by || '';
    by.setAttribute('aria-label', w.commission_by);
    by.addEventListener('input', () => { this.by = by.value; });
    row.append(element('span', w.commission_by), by, ...this.action('save', w.commission_save, () => ({
      by: by.value, confirmed: this.confirmed, config_crc32: this.is_checked() ? s.checked.config_crc32 : null })));
    const contradicted = this.confirmations(s.to_confirm.filter((name) => !OF_THE_DRAFT.includes(name)));
    const out = [element('p', w.commission_crc(crc_text(s.checked.config_crc32))), element('p', w.commission_save_help), contradicted, row];
    if (!s.saved) return out;
    const done = element('p', undefined, 'commission-row');
    done.append(element('b', w.commission_saved), link(w.commission_evidence, '/commissioning/evidence.zip'), ...this.action('restart', w.commission_restart));
    return [...out, done, element('pre', s.saved.evidence.join('\n'))];
  }

  // is_whole: other rows are shown.
  note_change(is_whole) {
    for (const box of this.panel.querySelectorAll('[data-confirms]')) box.checked = Boolean(this.confirmed[box.dataset.confirms]);
    if (is_whole) { this.shown = ''; this.show(); } else { this.show_space(); }
  }

  // ---- The cloud, the machine and its boxes as they are drafted

  show_space() {
    if (!this.canvas.isConnected || !recording) return;
    if (!this.scene) this.scene = new Scene3D(this.canvas);
    if (this.scene.fault) { this.canvas.hidden = true; this.space_note.textContent = words().commission_no_space; return; }
    this.show_cloud();
    this.scene.set_machine(this.outline());
    this.scene.set_boxes(this.draft.boxes, { editable: true, on_edit: (k, box, is_done) => {
      this.draft.boxes[k] = box.slice();
      this.confirmed.boxes = false;
      if (is_done) this.note_change(true);
    } });
  }

  // The live cloud stands where the daemon's mounting puts it; the draft's may be another one.
  show_cloud() {
    const cloud = recording.cloud_at(recording.frames - 1);
    if (cloud < 0) return;
    const [from, to] = recording.cloud_range(cloud), into_base = viewer.space.placer(recording.frame_of_cloud(cloud)), xyz = new Float32Array(3 * (to - from));
    const now = Object.fromEntries(this.state.mounting.map(({ key, value }) => [key, value]));
    const moved = move_between(MOUNTING.map((key) => Number(now[key])), this.draft.mounting);
    for (let k = from; k < to; ++k) xyz.set(moved(into_base([0, 1, 2].map((i) => recording.point_cm[3 * k + i] / 100))), 3 * (k - from));
    this.scene.set_cloud(xyz, recording.point_label.subarray(from, to), LAYERS.map(() => true));
  }

  outline() {
    const sign = this.draft.axis[0] === '-' ? -1 : 1, ahead = this.draft.axis[1] === 'X' ? [sign, 0, 0] : [0, sign, 0], left = [-ahead[1], ahead[0], 0];
    const { length_m, width_m } = recording.head.machine;
    const corner = (f, l) => [0, 1, 2].map((i) => f * length_m / 2 * ahead[i] + l * width_m / 2 * left[i]);
    return { corners: [corner(1, 1), corner(1, -1), corner(-1, -1), corner(-1, 1)], ahead, sensor: this.draft.mounting.slice(0, 3) };
  }
}

function numbers_of(text) { return (text || '').replace(/[[\],]/g, ' ').trim().split(/\s+/).filter(Boolean).map(Number); }
function same_members(a, b) { return JSON.stringify(Object.entries(a).sort()) === JSON.stringify(Object.entries(b).sort()); }
function crc_text(crc) { return `16#${crc.toString(16).toUpperCase().padStart(8, '0')}`; }

// base = Rz(yaw) Ry(pitch) Rx(roll) lidar + position.
function turned_by([, , , roll, pitch, yaw]) {
  const [cr, sr, cp, sp, cy, sy] = [roll, pitch, yaw].flatMap((angle) => [Math.cos(angle), Math.sin(angle)]);
  return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr], [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]];
}

// A point of base by the mounting of before, as it stands by another one.
function move_between(before, after) {
  const back = turned_by(before), there = turned_by(after);
  return (p) => {
    const off = [0, 1, 2].map((i) => p[i] - before[i]), lidar = [0, 1, 2].map((i) => back[0][i] * off[0] + back[1][i] * off[1] + back[2][i] * off[2]);
    return [0, 1, 2].map((i) => there[i][0] * lidar[0] + there[i][1] * lidar[1] + there[i][2] * lidar[2] + after[i]);
  };
}

function button(text, act) {
  const out = element('button', text);
  out.type = 'button';
  out.addEventListener('click', act);
  return out;
}

function link(text, where) {
  const out = element('a', text);
  Object.assign(out, { href: where, target: '_blank', rel: 'noopener' });
  return out;
}

function check_box(is_set, act) {
  const out = element('input');
  Object.assign(out, { type: 'checkbox', checked: Boolean(is_set) });
  out.addEventListener('change', () => act(out.checked));
  return out;
}

function number_field(name, unit, value, digits, act) {
  const label = element('label', `${name} `), input = element('input');
  Object.assign(input, { type: 'number', step: 'any', value: value.toFixed(digits) });
  input.addEventListener('change', () => { if (Number.isFinite(input.valueAsNumber)) act(input.valueAsNumber); });
  label.append(input, unit);
  return label;
}
