// The path from above and the series over time, of the global motion.

const state_colour = (state) => colour(STATE_COLOURS[STATES[state]]);

class PathView {
  constructor(canvas, on_frame) {
    this.canvas = canvas;
    canvas.addEventListener('pointerdown', (event) => {
      const near = this.nearest(event.offsetX, event.offsetY);
      if (near >= 0) on_frame(near);
    });
  }

  // One scale for both axes, so that turns look as they are.
  fit(width, height) {
    let x0 = Infinity, x1 = -Infinity, y0 = Infinity, y1 = -Infinity;
    for (const places of [motion.place, motion.true_place]) {
      for (let f = 0; places && f < motion.frames; ++f) {
        const x = places[3 * f], y = places[3 * f + 1];
        if (!Number.isFinite(x)) continue;
        x0 = Math.min(x0, x); x1 = Math.max(x1, x); y0 = Math.min(y0, y); y1 = Math.max(y1, y);
      }
    }
    if (!(x0 <= x1)) [x0, x1, y0, y1] = [-1, 1, -1, 1];
    const scale = Math.min((width - 80) / Math.max(1, x1 - x0), (height - 50) / Math.max(1, y1 - y0));
    this.x_of = (x) => width / 2 + (x - (x0 + x1) / 2) * scale;
    this.y_of = (y) => height / 2 - (y - (y0 + y1) / 2) * scale;
    return scale;
  }

  point(places, f) { return [this.x_of(places[3 * f]), this.y_of(places[3 * f + 1])]; }

  nearest(x, y) {
    let best = -1, least = Infinity;
    for (let f = 0; f < motion.frames; ++f) {
      const [px, py] = this.point(motion.place, f), d = Math.hypot(px - x, py - y);
      if (d < least) { least = d; best = f; }
    }
    return best;
  }

  draw(frame) {
    const { pen, width, height } = begin(this.canvas), scale = this.fit(width, height);
    if (motion.true_place) this.line(pen, motion.true_place, () => colour('truth'), 1.2, [5, 4]);
    this.line(pen, motion.place, (f) => state_colour(motion.state[f]), 2.4);
    const step = round_step(width / scale, 6), x = 20, y = height - 14;
    stroke(pen, [[x, y], [x + step * scale, y]], colour('ink'), 2);
    label(pen, `${step} m`, x + step * scale + 6, y + 4, colour('faint'));
    if (Number.isFinite(motion.place[3 * frame])) dot(pen, this.point(motion.place, frame), 5, colour('machine'));
  }

  // In pieces of one colour; broken where there is no place.
  line(pen, places, style_of, width, dash) {
    let run = [], style = '';
    const finish = () => { if (run.length === 1) dot(pen, run[0], 2, style); else stroke(pen, run, style, width, dash); };
    for (let f = 0; f < motion.frames; ++f) {
      const is_there = Number.isFinite(places[3 * f]), next = style_of(f);
      if (run.length && (!is_there || next !== style)) {
        const last = run[run.length - 1];
        finish();
        run = is_there ? [last] : [];
      }
      style = next;
      if (is_there) run.push(this.point(places, f));
    }
    if (run.length) finish();
  }
}

// One series with its level as a band, and the states below it.
class Series {
  constructor(name, value, level, holder, on_frame) {
    Object.assign(this, { name, value, level });
    const box = element('div', undefined, 'chart');
    this.canvas = element('canvas');
    this.canvas.id = `chart-${name}`;
    box.append(this.canvas);
    holder.append(box);
    const go = (event) => {
      const inside = Math.max(1, this.canvas.clientWidth - Series.kLeft - Series.kRight);
      on_frame(Math.round((event.offsetX - Series.kLeft) / inside * Math.max(1, motion.frames - 1)));
    };
    this.canvas.addEventListener('pointerdown', go);
    this.canvas.addEventListener('pointermove', (event) => { if (event.buttons & 1) go(event); });
  }

  // The values and some of the band: a level that widens without end must not flatten the line.
  range() {
    let low = Infinity, high = -Infinity, widest = 0;
    for (let f = 0; f < motion.frames; ++f) {
      if (!Number.isFinite(this.value(f))) continue;
      low = Math.min(low, this.value(f)); high = Math.max(high, this.value(f));
      if (Number.isFinite(this.level(f))) widest = Math.max(widest, this.level(f));
    }
    if (!(low <= high)) return [-1, 1];
    const room = Math.max(0.1 * (high - low), Math.min(1.2 * widest, Math.max(0.5 * (high - low), 0.02)));
    return [low - room, high + room];
  }

  draw(frame) {
    const { pen, width, height } = begin(this.canvas), [low, high] = this.range();
    const inside = Math.max(1, width - Series.kLeft - Series.kRight), bottom = height - 22, last = Math.max(1, motion.frames - 1);
    const x_of = (f) => Series.kLeft + f / last * inside, y_of = (v) => 4 + (high - v) / (high - low) * (bottom - 4);
    this.axes(pen, width, bottom, low, high, y_of);
    pen.save();
    pen.beginPath();
    pen.rect(Series.kLeft, 4, inside, bottom - 4);
    pen.clip();
    this.band_and_line(pen, x_of, y_of, bottom);
    pen.restore();
    const wide = Math.max(1, inside / last);
    for (let f = 0; f < motion.frames; ++f) {
      pen.fillStyle = state_colour(motion.state[f]);
      pen.fillRect(Math.max(Series.kLeft, x_of(f - 0.5)), bottom + 2, wide + 0.3, 6);
    }
    stroke(pen, [[x_of(frame), 0], [x_of(frame), height]], colour('ink'), 1);
  }

  axes(pen, width, bottom, low, high, y_of) {
    const step = round_step(high - low, 4), digits = Math.max(0, Math.ceil(-Math.log10(step)));
    for (let v = Math.ceil(low / step) * step; v <= high; v += step) {
      stroke(pen, [[Series.kLeft, y_of(v)], [width - Series.kRight, y_of(v)]], colour('line'), 1);
      label(pen, (Math.abs(v) < step / 2 ? 0 : v).toFixed(digits), Series.kLeft - 6, y_of(v) + 4, colour('faint'), 'right');
    }
    label(pen, words()[this.name], Series.kLeft + 6, 16, colour('ink'));
  }

  band_and_line(pen, x_of, y_of, bottom) {
    // Grey where the place along the road was not measured.
    const style_of = (f) => colour(motion.state[f] === MEASURED ? 'left' : 'other');
    pen.globalAlpha = 0.22;
    for (let f = 0; f < motion.frames; ++f) {
      pen.fillStyle = style_of(f);
      const v = this.value(f), level = this.level(f);
      if (!Number.isFinite(v) || !Number.isFinite(level)) continue;
      const top = Math.max(-10, y_of(v + level)), below = Math.min(bottom + 10, y_of(v - level));
      pen.fillRect(x_of(f - 0.5), top, x_of(f + 0.5) - x_of(f - 0.5) + 0.3, Math.max(1, below - top));
    }
    pen.globalAlpha = 1;
    let run = [], style = '';
    const finish = () => {
      if (run.length === 1) dot(pen, run[0], 2, style);
      else stroke(pen, run, style, 1.6);
      run = [];
    };
    for (let f = 0; f < motion.frames; ++f) {
      const v = this.value(f), last = run[run.length - 1];
      if (!Number.isFinite(v)) { finish(); continue; }
      if (run.length && style_of(f) !== style) { finish(); run = [last]; }
      style = style_of(f);
      run.push([x_of(f), y_of(v)]);
    }
    finish();
  }
}
Series.kLeft = 58;
Series.kRight = 12;
