// Seven time series, one below the other, on one axis of frames.

class Charts {
  constructor(recording, holder, on_frame) {
    this.recording = recording;
    this.on_frame = on_frame;
    this.from = 0;
    this.to = Math.max(1, recording.frames - 1);
    this.canvases = QUANTITIES.map((name) => {
      const box = document.createElement('div');
      box.className = 'chart';
      const canvas = document.createElement('canvas');
      canvas.id = `chart-${name}`;
      box.append(canvas);
      holder.append(box);
      this.listen(canvas);
      return canvas;
    });
    this.ranges = QUANTITIES.map((_, q) => this.range_of(q));
  }

  listen(canvas) {
    const frame_at = (event) => {
      const share = (event.offsetX - Charts.kLeft) / Math.max(1, canvas.clientWidth - Charts.kLeft - Charts.kRight);
      return this.from + share * (this.to - this.from);
    };
    canvas.addEventListener('pointerdown', (event) => this.on_frame(Math.round(frame_at(event))));
    canvas.addEventListener('pointermove', (event) => { if (event.buttons & 1) this.on_frame(Math.round(frame_at(event))); });
    canvas.addEventListener('wheel', (event) => { event.preventDefault(); this.zoom(frame_at(event), event.deltaY); }, { passive: false });
    canvas.addEventListener('dblclick', () => this.show(0, this.recording.frames - 1));
  }

  zoom(centre, direction) {
    const factor = direction > 0 ? 1.25 : 0.8;
    const last = Math.max(1, this.recording.frames - 1);
    const span = Math.min(last, Math.max(4, (this.to - this.from) * factor));
    const share = (centre - this.from) / (this.to - this.from);
    const from = Math.min(Math.max(0, centre - share * span), last - span);
    this.show(from, from + span);
  }

  show(from, to) {
    this.from = from;
    this.to = Math.max(from + 1, to);
    this.draw();
  }

  // The values that were measured and some of the band: a level of metres must not flatten the line.
  range_of(q) {
    const r = this.recording, unit = r.unit(q);
    let low = Infinity, high = -Infinity;
    for (let f = 0; f < r.frames; ++f) {
      const i = r.at(f, q);
      const shown = r.state[i] >= 2 ? [r.value[i], r.truth[i]] : [r.truth[i]];
      for (const x of shown) if (Number.isFinite(x)) { low = Math.min(low, x * unit); high = Math.max(high, x * unit); }
    }
    if (!(low <= high)) return [-1, 1];
    const room = Math.max(1.2 * r.alert(q), 0.1 * (high - low));
    return [low - room, high + room];
  }

  mark(frame) {
    this.frame = frame;
    if (frame < this.from || frame > this.to) {
      const span = this.to - this.from, last = Math.max(1, this.recording.frames - 1);
      this.from = Math.min(Math.max(0, frame - span / 2), Math.max(0, last - span));
      this.to = this.from + span;
    }
    this.draw();
  }

  draw() { this.canvases.forEach((canvas, q) => this.draw_one(canvas, q)); }

  draw_one(canvas, q) {
    const { pen, width, height } = begin(canvas);
    if (this.is_apart && this.recording.other) return this.draw_apart(pen, q, width, height);
    const inside = Math.max(1, width - Charts.kLeft - Charts.kRight), bottom = height - 22;
    const [low, high] = this.ranges[q];
    const x_of = (f) => Charts.kLeft + (f - this.from) / (this.to - this.from) * inside;
    const y_of = (v) => 4 + (high - v) / (high - low) * (bottom - 4);
    this.draw_axes(pen, q, width, bottom, x_of, y_of);
    pen.save();
    pen.beginPath();
    pen.rect(Charts.kLeft, 4, inside, bottom - 4);
    pen.clip();
    const columns = this.columns(q, inside);
    this.draw_band(pen, columns, x_of, y_of);
    this.draw_lines(pen, columns, x_of, y_of, this.recording.alert(q));
    if (this.recording.other) this.draw_second(pen, q, x_of, y_of);
    pen.restore();
    this.draw_states(pen, columns, x_of, bottom, inside);
    if (this.frame !== undefined) stroke(pen, [[x_of(this.frame), 0], [x_of(this.frame), height]], colour('ink'), 1);
    return undefined;
  }

  // The values of a second run.
  draw_second(pen, q, x_of, y_of) {
    const r = this.recording;
    this.draw_run(pen, (f) => r.other.value[r.at(f, q)] * r.unit(q), (f) => r.other.state[r.at(f, q)] === VALID, x_of, y_of);
  }

  // A line by frames, broken where there is no number: solid where it is valid, else dashed as far as to its neighbours. A
  // number alone is a dot, and a ring where it is not valid.
  draw_run(pen, value_of, is_valid, x_of, y_of) {
    const style = colour('second'), first = Math.max(0, Math.floor(this.from)), last = Math.min(this.recording.frames - 1, Math.ceil(this.to));
    let run = [], is_solid = true;
    const finish = () => {
      if (run.length === 1) (is_solid ? dot : ring)(pen, run[0], 2, style);
      else stroke(pen, run, style, is_solid ? 1.8 : 1.1, is_solid ? [] : [2, 3]);
      run = [];
    };
    for (let f = first; f <= last; ++f) {
      const v = value_of(f), point = [x_of(f), y_of(v)], is_now = is_valid(f);
      if (!Number.isFinite(v)) { finish(); continue; }
      if (run.length && is_now !== is_solid) {
        const before = run[run.length - 1];
        if (!is_now) { finish(); run = [before]; } else { run.push(point); finish(); }
      }
      is_solid = is_now;
      run.push(point);
    }
    finish();
  }

  // The second run less the first, in a range of its own.
  draw_apart(pen, q, width, height) {
    const r = this.recording, inside = Math.max(1, width - Charts.kLeft - Charts.kRight), bottom = height - 22;
    let most = 0.01 * r.alert(q);
    for (let f = 0; f < r.frames; ++f) if (Math.abs(r.other.difference(f, q)) > most) most = Math.abs(r.other.difference(f, q));
    const x_of = (f) => Charts.kLeft + (f - this.from) / (this.to - this.from) * inside, y_of = (v) => 4 + (1.15 * most - v) / (2.3 * most) * (bottom - 4);
    this.draw_axes(pen, q, width, bottom, x_of, y_of, [-1.15 * most, 1.15 * most]);
    pen.save();
    pen.beginPath();
    pen.rect(Charts.kLeft, 4, inside, bottom - 4);
    pen.clip();
    const are_valid = (f) => [r.state, r.other.state].every((states) => states[r.at(f, q)] === VALID);
    this.draw_run(pen, (f) => r.other.difference(f, q), are_valid, x_of, y_of);
    pen.restore();
    if (this.frame !== undefined) stroke(pen, [[x_of(this.frame), 0], [x_of(this.frame), height]], colour('ink'), 1);
  }

  draw_axes(pen, q, width, bottom, x_of, y_of, range = this.ranges[q]) {
    const [low, high] = range, step = round_step(high - low, 4);
    for (let v = Math.ceil(low / step) * step; v <= high; v += step) {
      stroke(pen, [[Charts.kLeft, y_of(v)], [width - Charts.kRight, y_of(v)]], colour('line'), 1);
      label(pen, (Math.abs(v) < step / 2 ? 0 : v).toFixed(Math.max(0, Math.ceil(-Math.log10(step)))), Charts.kLeft - 6, y_of(v) + 4, colour('faint'), 'right');
    }
    const unit = this.recording.is_angle(q) ? '°' : 'm';
    label(pen, `${name_text(q)} [${unit}]`, Charts.kLeft + 6, 16, colour('ink'));
    if (q !== QUANTITIES.length - 1) return;
    const told = [];
    for (const [f, text] of clock_ticks(this.recording, this.from, this.to, (width - Charts.kLeft) / 100)) {
      stroke(pen, [[x_of(f), bottom + 7], [x_of(f), bottom + 10]], colour('faint'), 1);
      tick_label(pen, text, x_of(f), bottom + 20, told, width);
    }
  }

  // No more of them than pixels: extremes of the frames that fall into one.
  columns(q, inside) {
    const r = this.recording, unit = r.unit(q), out = [];
    const first = Math.max(0, Math.floor(this.from)), last = Math.min(r.frames - 1, Math.ceil(this.to));
    const per = Math.max(1, Math.floor((last - first + 1) / inside));
    for (let f = first; f <= last; f += per) {
      const c = { f, to: Math.min(last, f + per - 1), low: NaN, high: NaN, band_low: NaN, band_high: NaN, truth: NaN, state: 3 };
      for (let k = f; k <= c.to; ++k) {
        const i = r.at(k, q), v = r.value[i] * unit, level = r.level[i] * unit;
        c.state = r.state[i] === UNREADABLE || c.state === UNREADABLE ? UNREADABLE : Math.min(c.state, r.state[i]);
        if (Number.isFinite(r.truth[i])) c.truth = r.truth[i] * unit;
        if (!Number.isFinite(v) || r.state[i] === INVALID) continue;
        const lower = (a, b) => (a <= b ? a : b), higher = (a, b) => (a >= b ? a : b);
        c.low = lower(c.low, v); c.high = higher(c.high, v);
        c.band_low = lower(c.band_low, v - level); c.band_high = higher(c.band_high, v + level);
      }
      out.push(c);
    }
    return out;
  }

  draw_band(pen, columns, x_of, y_of) {
    pen.globalAlpha = 0.22;
    for (const c of columns) {
      if (!Number.isFinite(c.band_low)) continue;
      pen.fillStyle = colour(c.state === VALID ? 'left' : 'other');
      const x = x_of(c.f - 0.5), wide = Math.max(1, x_of(c.to + 0.5) - x);
      const top = Math.max(-10, y_of(c.band_high)), below = Math.min(1e4, y_of(c.band_low));
      pen.fillRect(x, top, wide + 0.3, Math.max(1, below - top));
    }
    pen.globalAlpha = 1;
  }

  draw_lines(pen, columns, x_of, y_of, alert) {
    const runs = (value, style, width, dash) => {
      let run = [];
      const finish = () => {
        // A single frame between two gaps would be a line without length.
        if (run.length && run.every(([x]) => x === run[0][0])) dot(pen, run[0], 2, style);
        stroke(pen, run, style, width, dash);
        run = [];
      };
      columns.forEach((c, k) => {
        const points = value(c, columns[k - 1], columns[k + 1]);
        if (points.every(Number.isFinite)) for (const v of points) run.push([x_of((c.f + c.to) / 2), y_of(v)]);
        else finish();
      });
      finish();
    };
    runs((c) => [c.low - alert], colour('faint'), 1, [1, 4]);
    runs((c) => [c.high + alert], colour('faint'), 1, [1, 4]);
    // Valid values stand out; the others are grey, and held ones dashed. Grey lines reach to their neighbours.
    const of_state = (is_meant) => (c, before, after) => {
      if (is_meant(c.state)) return [c.low, c.high];
      return [before, after].some((other) => other && is_meant(other.state)) ? [c.low] : [NaN];
    };
    runs(of_state((state) => state < VALID && state !== HELD), colour('other'), 1.6);
    runs(of_state((state) => state === HELD), colour('other'), 1.6, [5, 4]);
    runs((c) => (c.state === VALID ? [c.low, c.high] : [NaN]), colour('left'), 2);
    if (this.recording.has_truth) runs((c) => [c.truth], colour('truth'), 1.2, [5, 4]);
  }

  draw_states(pen, columns, x_of, bottom, inside) {
    for (const c of columns) {
      const x = x_of(c.f - 0.5);
      pen.fillStyle = colour(STATES[c.state]);
      const from = Math.max(Charts.kLeft, x), to = Math.min(Charts.kLeft + inside, x_of(c.to + 0.5) + 0.3);
      pen.fillRect(from, bottom + 2, Math.max(1, to - from), 5);
    }
  }
}
Charts.kLeft = 58;
Charts.kRight = 12;
