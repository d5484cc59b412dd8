// One frame from above and in section, its points coloured by their use. Metres along the road, to its left and up.

const LAYERS = ['other', 'floor', 'left', 'right', 'dropped'], YAW = 2;
const kTickEdge_px = 20;  // half of the words of a tick

class View {
  // axes: which two of (along, left, up) lie to the right and up on the screen, and the sign of each.
  constructor(canvas, axes, usual, on_change) {
    Object.assign(this, { canvas, axes, usual, centre: null, metres: null });
    this.reset();
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(event.deltaY > 0 ? 1.2 : 1 / 1.2, event.offsetX, event.offsetY);
      on_change();
    }, { passive: false });
    canvas.addEventListener('pointermove', (event) => {
      if (!(event.buttons & 1) || event.pointerType === 'touch') return;
      this.pan(event.movementX, event.movementY);
      on_change();
    });
    this.listen_to_fingers(on_change);
    canvas.addEventListener('dblclick', () => { this.reset(); on_change(); });
  }

  // One finger scrolls the page. Two zoom by their distance and move by their middle.
  listen_to_fingers(on_change) {
    let before = null;
    const fingers = (event) => {
      const box = this.canvas.getBoundingClientRect(), [a, b] = Array.from(event.touches, (t) => [t.clientX - box.left, t.clientY - box.top]);
      return { x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2, apart: Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1])) };
    };
    const take = (event) => {
      if (event.touches.length !== 2) { before = null; return; }
      if (event.cancelable) event.preventDefault();
      const now = fingers(event);
      if (before) {
        this.pan(now.x - before.x, now.y - before.y);
        this.zoom(before.apart / now.apart, now.x, now.y);
        on_change();
      }
      before = now;
    };
    for (const kind of ['touchstart', 'touchmove']) this.canvas.addEventListener(kind, take, { passive: false });
    for (const kind of ['touchend', 'touchcancel']) this.canvas.addEventListener(kind, () => { before = null; });
  }

  pan(dx, dy) {
    this.centre[0] -= dx / this.scale();
    this.centre[1] += dy / this.scale();
  }

  reset() { this.centre = this.usual.centre.slice(); this.metres = this.usual.metres.slice(); }
  scale() { return Math.min(this.canvas.clientWidth / this.metres[0], this.canvas.clientHeight / this.metres[1]); }
  zoom(factor, x, y) {
    const s = this.scale();
    const dx = (x - this.canvas.clientWidth / 2) / s, dy = (this.canvas.clientHeight / 2 - y) / s;
    this.centre = [this.centre[0] + dx * (1 - factor), this.centre[1] + dy * (1 - factor)];
    this.metres = this.metres.map((m) => Math.min(400, Math.max(1, m * factor)));
  }
  place(p) {
    const s = this.scale(), [right, up] = this.axes;
    return [this.canvas.clientWidth / 2 + s * (right.sign * p[right.axis] - this.centre[0]),
      this.canvas.clientHeight / 2 - s * (up.sign * p[up.axis] - this.centre[1])];
  }
}

class Viewer {
  constructor(recording) {
    this.recording = recording;
    this.shown = LAYERS.map(() => true);
    this.planes_shown = true;
    this.boxes_shown = true;
    this.is_old = false;  // the points are not of now
    const again = () => this.draw(this.frame);
    this.top = new View(document.getElementById('top'), [{ axis: 0, sign: 1 }, { axis: 1, sign: 1 }], { centre: [0, 0], metres: [26, 12] }, again);
    this.section = new View(document.getElementById('section'), [{ axis: 1, sign: -1 }, { axis: 2, sign: 1 }], { centre: [0, 0.2], metres: [9, 6] }, again);
    this.space = new SpaceView(this);
  }

  draw(frame) {
    this.frame = frame;
    const cloud = this.recording.cloud_at(frame);
    this.draw_view(this.top, cloud, () => true);
    this.draw_view(this.section, cloud, (k) => Math.abs(this.recording.point_cm[3 * k]) <= 150);
    this.space.show(frame);
    return cloud < 0 ? -1 : this.recording.cloud_frame[cloud];
  }

  draw_view(view, cloud, in_view) {
    const { pen, width, height } = begin(view.canvas);
    this.draw_grid(pen, view, width, height);
    if (cloud >= 0) this.draw_points(pen, view, cloud, in_view);
    if (this.boxes_shown) this.draw_boxes(pen, view);
    if (!this.planes_shown) return;
    this.draw_walls(pen, view);
    if (view === this.section) this.draw_floor(pen, view);
    if (view === this.top) this.draw_machine(pen, view);
    this.draw_distances(pen, view);
    this.draw_sensor(pen, view);
  }

  draw_grid(pen, view, width, height) {
    const step = round_step(width / view.scale(), 8), s = view.scale();
    const first_x = Math.ceil((view.centre[0] - width / 2 / s) / step) * step;
    const first_y = Math.ceil((view.centre[1] - height / 2 / s) / step) * step;
    for (let x = first_x; x < view.centre[0] + width / 2 / s; x += step) {
      const at = width / 2 + s * (x - view.centre[0]);
      stroke(pen, [[at, 0], [at, height]], colour('line'), 1);
      if (at > kTickEdge_px && at < width - kTickEdge_px) label(pen, `${Number((view.axes[0].sign * x).toFixed(3))} m`, at, height - 5, colour('faint'), 'center');
    }
    for (let y = first_y; y < view.centre[1] + height / 2 / s; y += step) {
      const at = height / 2 - s * (y - view.centre[1]);
      stroke(pen, [[0, at], [width, at]], colour('line'), 1);
    }
  }

  draw_points(pen, view, cloud, in_view) {
    const r = this.recording, [from, to] = r.cloud_range(cloud), size = Math.min(3, Math.max(1.2, view.scale() / 40));
    pen.globalAlpha = this.is_old ? OLD_ALPHA : 1;
    LAYERS.forEach((layer, kind) => {
      if (!this.shown[kind]) return;
      pen.fillStyle = colour(this.is_old ? 'other' : layer);
      for (let k = from; k < to; ++k) {
        if (r.point_label[k] !== kind || !in_view(k)) continue;
        const [x, y] = view.place([r.point_cm[3 * k] / 100, r.point_cm[3 * k + 1] / 100, r.point_cm[3 * k + 2] / 100]);
        pen.fillRect(x - size / 2, y - size / 2, size, size);
      }
    });
    pen.globalAlpha = 1;
  }

  // [found, normal along, left, up, d, along_min, along_max, rms] of a side.
  wall(side) { return this.recording.planes.subarray(8 * (2 * this.frame + side), 8 * (2 * this.frame + side) + 8); }
  floor_up() { return this.recording.floor[3 * this.frame + 1]; }
  machine_point(k) { return this.recording.machine_point(this.frame, k); }

  draw_walls(pen, view) {
    for (const side of [0, 1]) {
      const [found, along, left, up, d, from, to] = this.wall(side);
      if (!found) continue;
      const left_at = (a, h) => -(d + along * a + up * h) / left, style = colour(side ? 'right' : 'left');
      const at = (a, h) => view.place([a, left_at(a, h), h]);
      // Pale where the engine refused it: both distances of the side are invalid.
      const is_refused = [0, 1].every((k) => this.recording.state[this.recording.at(this.frame, 3 + 2 * side + k)] === INVALID);
      pen.globalAlpha = is_refused ? 0.3 : 1;
      if (view === this.top) {
        stroke(pen, [at(-60, 0), at(60, 0)], style, 1.2, [3, 6]);
        stroke(pen, [at(from, 0), at(to, 0)], style, 2.6);
      } else {
        const low = this.floor_up();
        stroke(pen, [at(0, low), at(0, low + this.recording.head.wall_z_max)], style, 2.6);
      }
      pen.globalAlpha = 1;
    }
  }

  draw_floor(pen, view) {
    const known = this.recording.floor[3 * this.frame] > 0;
    if (known) stroke(pen, [view.place([0, -30, this.floor_up()]), view.place([0, 30, this.floor_up()])], colour('floor'), 2.2);
  }

  // Solid by raw; dashed by the value, where it is held or differs from raw.
  draw_machine(pen, view) {
    const corners = [0, 1, 2, 3].map((k) => this.machine_point(k)), r = this.recording, i = r.at(this.frame, YAW);
    const outline = (points, dash) => {
      const placed = points.map((p) => view.place(p));
      stroke(pen, placed.concat([placed[0]]), colour('machine'), 1.5, dash);
      dot(pen, [0, 1].map((axis) => (placed[0][axis] + placed[1][axis]) / 2), 4, colour('machine'));
    };
    pen.globalAlpha = 0.55;
    pen.fillStyle = colour(r.state[i] === VALID ? 'machine' : 'other');
    pen.beginPath();
    corners.map((p) => view.place(p)).forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.fill();
    pen.globalAlpha = 1;
    outline(corners, Number.isFinite(r.raw[i]) ? [] : [6, 5]);
    if (r.differs(this.frame, YAW)) outline(this.turned_right(corners, r.value[i] - r.raw[i]), [6, 5]);
  }

  // About the origin of base: a positive yaw turns the machine to the right.
  turned_right(points, angle_rad) {
    const [x, y] = this.base_point([0, 0, 0]), c = Math.cos(angle_rad), s = Math.sin(angle_rad);
    return points.map((p) => [x + c * (p[0] - x) + s * (p[1] - y), y - s * (p[0] - x) + c * (p[1] - y), p[2]]);
  }

  // A point of base as it is drawn.
  base_point([x, y, z]) {
    const { forward, left } = this.recording.head.machine, { origin, ahead, aside, up } = this.recording.axes_of(this.frame);
    const f = x * forward[0] + y * forward[1], l = x * left[0] + y * left[1];
    return [0, 1, 2].map((i) => origin[i] + f * ahead[i] + l * aside[i] + z * up[i]);
  }

  // The boxes of the machine's own body, in which points are left out: twelve edges each.
  draw_boxes(pen, view) {
    for (const box of this.recording.head.body_boxes) {
      const corner = (k) => view.place(this.base_point([box[k & 1], box[2 + (k >> 1 & 1)], box[4 + (k >> 2 & 1)]]));
      for (let k = 0; k < 8; ++k) {
        for (const bit of [1, 2, 4]) if (!(k & bit)) stroke(pen, [corner(k), corner(k | bit)], colour('dropped'), 1.2, [4, 3]);
      }
    }
  }

  draw_sensor(pen, view) { dot(pen, view.place(this.machine_point(4)), 4, colour('ink')); }

  draw_distances(pen, view) {
    for (let k = 0; k < 4; ++k) {
      const start = this.machine_point(5 + k);
      if (view === this.top) dot(pen, view.place(start), 4.5, colour('ink'));
      if (view === this.top || k % 2 === 0) this.draw_distance(pen, view, k, start);
    }
  }

  draw_distance(pen, view, k, start) {
    const r = this.recording, q = 3 + k, i = r.at(this.frame, q), state = r.state[i], side = k < 2 ? 0 : 1;
    const style = colour(state === VALID ? 'valid' : 'not-valid'), from = view.place(start);
    let to = view.place([start[0], start[1] + (side ? -1 : 1), start[2]]);
    if (Number.isFinite(r.value[i]) && state !== INVALID) {
      const has_raw = Number.isFinite(r.raw[i]), is_apart = r.differs(this.frame, q);
      to = view.place(this.foot_of(start, side, has_raw ? r.raw[i] : r.value[i]));
      stroke(pen, [from, to], style, 2.2, has_raw ? [] : [6, 5]);
      if (is_apart) this.draw_value_mark(pen, view, start, side, r.value[i], style);
    }
    this.draw_distance_lines(pen, view, k, this.distance_lines(q, i), to);
  }

  // In section in the upper corners; from above beyond the wall, where a narrow road leaves room, too.
  draw_distance_lines(pen, view, k, lines, foot) {
    const { clientWidth: width, clientHeight: height } = view.canvas, block = 15 * (lines.length - 1);
    if (view === this.section) return label_lines(pen, lines, k < 2 ? 8 : width - 8, 18, k < 2 ? 'left' : 'right');
    const y = k < 2 ? foot[1] - 12 - block : foot[1] + 22;
    label_lines(pen, lines, foot[0] + (k % 2 ? -4 : 4), Math.min(Math.max(16, y), height - 22 - block), k % 2 ? 'right' : 'left');
  }

  // Where the value ends when raw ends elsewhere: a dashed bar across the line.
  draw_value_mark(pen, view, start, side, value_m, style) {
    const end = [start[0], start[1] + (side ? -value_m : value_m), start[2]], [x, y] = view.place(end);
    if (view === this.top) stroke(pen, [[x - 14, y], [x + 14, y]], style, 2, [4, 3]);
    else stroke(pen, [[x, y - 14], [x, y + 14]], style, 2, [4, 3]);
  }

  // [name and number, state], the bound of the error, and the value where it differs.
  distance_lines(q, i) {
    const r = this.recording, w = words(), state = r.state[i], ink = colour(state === VALID ? 'ink' : 'not-valid');
    const state_part = [w.states[STATES[state]], colour(STATES[state])];
    if (state === INVALID || !Number.isFinite(r.value[i])) return [[[`${QUANTITIES[q]} `, ink], state_part]];
    const has_raw = Number.isFinite(r.raw[i]), shown_m = has_raw ? r.raw[i] : r.value[i], level_m = has_raw ? r.raw_level[i] : r.level[i];
    const lines = [[[`${QUANTITIES[q]} ${shown_m.toFixed(3)} m `, ink], state_part],
      [[w.at_most(`${level_m.toFixed(3)} m`), ink, !(level_m <= r.alert(q))]]];
    if (r.differs(this.frame, q)) lines.push([[w.value_is(`${r.value[i].toFixed(3)} m`), ink]]);
    return lines;
  }

  // Where the distance meets the plane; where there is no plane, straight to the side by the held value.
  foot_of(p, side, held_m) {
    const [found, along, left, up, d] = this.wall(side);
    if (!found) return [p[0], p[1] + (side ? -held_m : held_m), p[2]];
    const gap = along * p[0] + left * p[1] + up * p[2] + d;
    return [p[0] - gap * along, p[1] - gap * left, p[2] - gap * up];
  }
}
