// The map of the roadway with the machine on it, and what the obstacle stop permits. Only where the daemon has them.

// The stop answers ten times a second at least: so long without an answer is a stop.
const kNoAnswer_ms = 500, kNoScan_ms = 1000, kNearView_m = 40;

class RoadwayView {
  constructor(planar) {
    this.planar = planar;
    this.map = null;
    this.place = null;
    this.stop = null;
    this.stop_heard_ms = this.place_heard_ms = -Infinity;
    this.is_near = false;
    for (const id of ['roadway-panel', 'stop-line']) document.getElementById(id).hidden = false;
    document.getElementById('roadway-png').onclick = () => { if (recording) save_picture('roadway', [document.getElementById('roadway')]); };
    document.getElementById('roadway-zoom').onclick = () => { this.is_near = !this.is_near; this.show(); };
  }

  take_map(map) {
    const image = new Image();
    image.onload = () => { this.map = { ...map, image }; this.show(); };
    image.src = map.png;
  }

  take_place(place) {
    this.place = place;
    this.place_heard_ms = performance.now();
  }

  take_stop(stop) {
    this.stop = stop;
    this.stop_heard_ms = performance.now();
  }

  // What is not heard any more permits nothing.
  is_stop_known() { return this.stop && performance.now() - this.stop_heard_ms < kNoAnswer_ms; }

  // Only go lets the machine drive as fast as it likes.
  grade() { return this.is_stop_known() ? { go: 'good', slow: 'fair', stop: 'bad' }[this.stop.state] : 'bad'; }

  // What the stop permits, without the numbers that change with each answer.
  spoken() {
    const w = words();
    return this.is_stop_known() ? { go: w.stop_go, slow: w.stop_slows, stop: w.stop_stop }[this.stop.state] : w.stop_not_known;
  }

  // In base, for three dimensions: the machine as the stop reckons with it, and its way until it stands, by the motion
  // that was measured. Nothing is drawn ahead of a machine whose motion nobody knows.
  sweep([forward_x, forward_y]) {
    const { outline_m: [x_min, x_max, y_min, y_max], floor_z_m, top_m, latency_s, deceleration_m_s2 } = this.planar;
    const is_known = this.is_stop_known(), tint = { good: 'valid', fair: 'degraded', bad: 'invalid' }[this.grade()];
    const speed = (is_known && this.stop.speed_m_s) || 0, turn = (is_known && this.stop.turn_rad_s) || 0;
    const way_m = Math.abs(speed) * latency_s + speed * speed / (2 * deceleration_m_s2), time_s = speed ? way_m / Math.abs(speed) : 0;
    const steps = Math.min(12, Math.ceil(way_m / 0.25)), patches = [];
    for (let k = 0; k <= steps; ++k) {
      const share = steps ? k / steps : 0, yaw = turn * time_s * share, way = Math.sign(speed) * way_m * share;
      // Along the chord of the arc.
      const [c, s] = [Math.cos(yaw), Math.sin(yaw)], [hc, hs] = [Math.cos(yaw / 2), Math.sin(yaw / 2)];
      const to = [way * (hc * forward_x - hs * forward_y), way * (hs * forward_x + hc * forward_y)];
      const ring = (z) => [[x_min, y_min], [x_max, y_min], [x_max, y_max], [x_min, y_max]].map(([x, y]) => [to[0] + c * x - s * y, to[1] + s * x + c * y, z]);
      patches.push({ corners: ring(floor_z_m), tint });
      if (k === 0 || k === steps) patches.push({ corners: ring(floor_z_m + top_m), tint });
    }
    return { patches, nearest: is_known && this.stop.nearest_m ? [...this.stop.nearest_m, floor_z_m + 0.5] : null };
  }

  is_place_old() { return performance.now() - this.place_heard_ms > kNoScan_ms; }

  show() {
    this.show_stop();
    this.show_place();
    this.draw();
  }

  show_stop() {
    const w = words(), line = document.getElementById('stop-line');
    const say = (text, why = '') => {
      line.className = `panel ${this.grade()}`;
      if (line.textContent !== `${text} ${why}`.trim()) line.replaceChildren(element('b', text), why && ` ${why}`);
    };
    if (!this.is_stop_known()) return say(w.stop_not_known);
    const text = this.stop.state === 'slow' ? w.stop_slow(number_text(this.stop.allowed_speed_m_s, 2)) : this.stop.state === 'go' ? w.stop_go : w.stop_stop;
    return say(text, this.stop.why[page.language]);
  }

  show_place() {
    const w = words(), line = document.getElementById('place-line'), place = this.place;
    document.getElementById('roadway-zoom').textContent = this.is_near ? w.whole_map : w.around_machine;
    if (!place) return fill('place-line', w.no_place_yet);
    if (page.paused) return fill('place-line', w.place_paused);
    if (this.is_place_old()) return fill('place-line', w.no_scan_comes);
    const state = w.place_states[place.state] || place.state;
    const at = place.pose ? w.place_at(number_text(place.pose[0], 2), number_text(place.pose[1], 2), number_text(place.pose[2] * 180 / Math.PI, 1)) : '';
    line.textContent = `${w.place_is(state)} ${at}`;
    return line;
  }

  // Corners of what is shown, in metres of the map.
  window() {
    const pose = this.place && this.place.pose;
    if (this.is_near && pose) {
      return [pose[0] - kNearView_m / 2, pose[0] + kNearView_m / 2, pose[1] - kNearView_m / 4, pose[1] + kNearView_m / 4];
    }
    if (!this.map) return pose ? [pose[0] - 10, pose[0] + 10, pose[1] - 10, pose[1] + 10] : null;
    const [x, y] = this.map.origin_m, [width, height] = this.map.size_m;
    return [x, x + width, y, y + height];
  }

  draw() {
    const canvas = document.getElementById('roadway'), { pen, width, height } = begin(canvas), shown = this.window();
    this.colour = (name) => colour(name, canvas);
    pen.fillStyle = this.colour('unknown');
    pen.fillRect(0, 0, width, height);
    if (!shown) return;
    const scale = Math.min(width / (shown[1] - shown[0]), height / (shown[3] - shown[2]));
    const middle = [(shown[0] + shown[1]) / 2, (shown[2] + shown[3]) / 2];
    const at = ([x, y]) => [width / 2 + (x - middle[0]) * scale, height / 2 - (y - middle[1]) * scale];
    if (this.map) {
      const [x, y] = this.map.origin_m, [wide, high] = this.map.size_m, corner = at([x, y + high]);
      pen.imageSmoothingEnabled = scale * wide < this.map.image.width;
      pen.drawImage(this.map.image, corner[0], corner[1], wide * scale, high * scale);
    }
    if (this.place) this.draw_place(pen, at);
    this.draw_scale(pen, width, height, scale);
  }

  draw_place(pen, at) {
    if (this.place.track.length > 1) stroke(pen, this.place.track.map(at), this.colour('left'), 1.6);
    for (const candidate of this.place.candidates) this.draw_machine(pen, at, candidate, this.colour('not-valid'), [4, 3]);
    if (!this.place.pose) return;
    this.draw_machine(pen, at, this.place.pose, this.colour(this.is_place_old() ? 'not-valid' : 'machine'));
    if (!this.is_stop_known() || !this.stop.nearest_m) return;
    dot(pen, at(this.placed(this.place.pose, this.stop.nearest_m)), 4, this.colour('invalid'));
  }

  placed([x, y, yaw], [px, py]) {
    return [x + Math.cos(yaw) * px - Math.sin(yaw) * py, y + Math.sin(yaw) * px + Math.cos(yaw) * py];
  }

  draw_machine(pen, at, pose, style, dash) {
    const [x_min, x_max, y_min, y_max] = this.planar.outline_m, corner = (x, y) => at(this.placed(pose, [x, y]));
    const outline = [corner(x_min, y_min), corner(x_max, y_min), corner(x_max, y_max), corner(x_min, y_max), corner(x_min, y_min)];
    // With a dark edge: yellow alone is lost on what is free.
    if (!dash) for (const line of [outline, [at(pose), corner(x_max, 0)]]) stroke(pen, line, this.colour('ink'), 4);
    stroke(pen, outline, style, 2, dash);
    dot(pen, at(pose), 3, style);
    stroke(pen, [at(pose), corner(x_max, 0)], style, 2, dash);
  }

  draw_scale(pen, width, height, scale) {
    const length_m = round_step(width / scale, 6), y = height - 12;
    stroke(pen, [[12, y], [12 + length_m * scale, y]], this.colour('ink'), 2);
    label(pen, `${length_m} m`, 12, y - 6, this.colour('ink'), 'left', this.colour('unknown'));
  }
}
