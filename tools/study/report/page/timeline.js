// The time line of a report, under its slider: states of all frames, times, and the way to what is not valid.

class Timeline {
  constructor(recording, on_frame) {
    Object.assign(this, { recording, on_frame, of: -1, frame: 0, canvas: document.getElementById('timeline') });
    const go = (event) => this.on_frame(Math.round((event.offsetX - Timeline.kEdge) / this.inside() * (recording.frames - 1)));
    this.canvas.addEventListener('pointerdown', go);
    this.canvas.addEventListener('pointermove', (event) => { if (event.buttons & 1) go(event); });
    const select = document.getElementById('jump-of');
    select.append(...[-1, ...QUANTITIES.keys()].map((q) => Object.assign(document.createElement('option'), { value: q })));
    on('jump-of', 'change', () => { this.of = Number(select.value); this.say(); this.draw(); });
    on('jump-next', 'click', () => this.jump(1));
    on('jump-back', 'click', () => this.jump(-1));
  }

  inside() { return Math.max(1, this.canvas.clientWidth - 2 * Timeline.kEdge); }
  is_bad(f, q) { return this.recording.state[this.recording.at(f, q)] !== VALID; }
  quantities() { return this.of < 0 ? [...QUANTITIES.keys()] : [this.of]; }

  // Those of which a stretch begins here that is not valid.
  begun(f) { return this.quantities().filter((q) => this.is_bad(f, q) && (f === 0 || !this.is_bad(f - 1, q))); }

  jump(step) {
    const w = words(), { frames } = this.recording;
    for (let f = this.frame + step; f >= 0 && f < frames; f += step) {
      const begun = this.begun(f);
      if (!begun.length) continue;
      this.on_frame(f);
      this.note = () => words().jumped(begun.map((q) => words().names[QUANTITIES[q]]));
      return this.say();
    }
    this.note = () => (step > 0 ? words().no_later : words().no_earlier);
    return this.say();
  }

  say() {
    const w = words();
    document.querySelectorAll('#jump-of option').forEach((option, k) => { option.textContent = k ? name_text(k - 1) : w.any_value; });
    const first_s = this.recording.stamp_s[first_stamp(this.recording)];
    document.getElementById('clock-note').textContent = has_clock(this.recording) ? w.clock_note(date_text(first_s)) : w.no_clock_note;
    document.getElementById('jump-note').textContent = this.note ? this.note() : '';
  }

  mark(frame) {
    if (frame !== this.frame) this.note = null;
    this.frame = frame;
    this.say();
    this.draw();
  }

  // The worst of the frames that fall into a pixel.
  state_of(from, to) {
    const r = this.recording, of = this.quantities();
    let worst = VALID;
    for (let f = from; f <= to; ++f) {
      for (const q of of) {
        const state = r.state[r.at(f, q)];
        if (state === UNREADABLE || worst === UNREADABLE) worst = UNREADABLE; else worst = Math.min(worst, state);
      }
    }
    return worst;
  }

  draw() {
    const r = this.recording, { pen, width } = begin(this.canvas), inside = this.inside(), last = Math.max(1, r.frames - 1);
    const x_of = (f) => Timeline.kEdge + f / last * inside, per = Math.max(1, Math.floor(r.frames / inside));
    for (let f = 0; f < r.frames; f += per) {
      const to = Math.min(r.frames - 1, f + per - 1), x = Math.max(Timeline.kEdge, x_of(f - 0.5));
      pen.fillStyle = colour(STATES[this.state_of(f, to)]);
      pen.fillRect(x, 4, Math.max(1, Math.min(Timeline.kEdge + inside, x_of(to + 0.5)) - x + 0.3), 12);
    }
    const told = [];
    for (const [f, text] of clock_ticks(r, 0, r.frames - 1, inside / 90)) {
      const x = x_of(f);
      stroke(pen, [[x, 16], [x, 21]], colour('faint'), 1);
      tick_label(pen, text, x, 33, told, width);
    }
    const x = x_of(this.frame);
    stroke(pen, [[x, 0], [x, 20]], colour('ink'), 2);
  }
}
Timeline.kEdge = 8;
