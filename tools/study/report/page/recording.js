// The data of a recording as typed arrays.

function bytesOf(text) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

class Recording {
  constructor(data) {
    const float = (name) => new Float32Array(bytesOf(data[name]));
    const whole = (name) => new Uint32Array(bytesOf(data[name]));
    Object.assign(this, { head: data.head, words: data.words, frames: data.frames, source: data.source, error: data.error });
    for (const name of ['value', 'raw', 'sigma', 'level', 'raw_level', 'part', 'age_s', 'truth', 'engine_ms', 'confidence', 'planes', 'floor',
      'machine', 'stage_ms']) this[name] = float(name);
    for (const name of ['reasons', 'frame_reasons', 'counts', 'cloud_frame', 'cloud_first']) this[name] = whole(name);
    this.state = new Uint8Array(bytesOf(data.state));
    this.cause = new Uint8Array(bytesOf(data.cause));
    this.steer = new Uint8Array(bytesOf(data.steer));
    this.positive_means = data.positive_means;
    this.stamp_s = new Float64Array(bytesOf(data.stamp_s));
    this.point_cm = new Int16Array(bytesOf(data.point_cm));
    this.point_label = new Uint8Array(bytesOf(data.point_label));
    this.has_truth = this.truth.some(Number.isFinite);
  }

  number_of(frame) { return frame; }
  at(frame, quantity) { return 7 * frame + quantity; }
  is_angle(quantity) { return quantity < 3; }
  // To degrees, or metres as they are.
  unit(quantity) { return this.is_angle(quantity) ? 180 / Math.PI : 1; }
  // The parts of its level, in rad or m.
  parts(frame, quantity) {
    const n = this.words.parts.length, i = n * this.at(frame, quantity);
    return Array.from(this.part.subarray(i, i + n));
  }
  has_level(frame, quantity) { return this.cause[this.at(frame, quantity)] < this.words.parts.length; }
  alert(quantity) { return this.is_angle(quantity) ? this.head.alert_deg : this.head.alert_m; }
  error_of(frame, quantity) {
    const i = this.at(frame, quantity);
    let error = this.value[i] - this.truth[i];
    if (this.is_angle(quantity)) error = Math.atan2(Math.sin(error), Math.cos(error));
    return error * this.unit(quantity);
  }
  // In degrees or m; an invalid value has no bound to rely on.
  bound_of(frame, quantity) {
    const i = this.at(frame, quantity);
    return this.state[i] === INVALID ? NaN : this.level[i] * this.unit(quantity);
  }
  // The value departs from raw by more than noise: three standard deviations of raw.
  differs(frame, quantity) {
    const i = this.at(frame, quantity);
    return Number.isFinite(this.raw[i]) && Math.abs(this.value[i] - this.raw[i]) > 3 * this.sigma[i];
  }
  reason_bits(bits) {
    const out = [];
    for (let bit = 0; bit < this.words.reason_names.length; ++bit) if (bits >>> bit & 1) out.push(bit);
    return out;
  }

  // Of the machine's outline four corners, from left of the nose clockwise; the sensor; four sampling points. As drawn.
  machine_point(frame, k) { return Array.from(this.machine.subarray(27 * frame + 3 * k, 27 * frame + 3 * k + 3)); }
  // Where base lies in what is drawn of a frame: its origin, and the ways ahead, to the left and up.
  axes_of(frame) {
    const { length_m, width_m } = this.head.machine, corners = [0, 1, 2, 3].map((k) => this.machine_point(frame, k));
    const middle = (a, b) => [0, 1, 2].map((i) => (corners[a][i] + corners[b][i]) / 2), origin = [0, 1, 2].map((i) => (middle(0, 1)[i] + middle(2, 3)[i]) / 2);
    const ahead = middle(0, 1).map((v, i) => (v - origin[i]) / (length_m / 2)), aside = middle(0, 3).map((v, i) => (v - origin[i]) / (width_m / 2));
    const up = [0, 1, 2].map((i) => ahead[(i + 1) % 3] * aside[(i + 2) % 3] - ahead[(i + 2) % 3] * aside[(i + 1) % 3]);
    return { origin, ahead, aside, up };
  }
  // The frame whose points these are.
  frame_of_cloud(cloud) { return this.cloud_frame[cloud]; }

  // The last frame up to this one whose points are kept: its place in the list of clouds, or -1.
  cloud_at(frame) {
    let low = 0, high = this.cloud_frame.length;
    while (low < high) {
      const middle = low + high >> 1;
      if (this.cloud_frame[middle] <= frame) low = middle + 1; else high = middle;
    }
    return low - 1;
  }
  cloud_range(cloud) {
    const next = cloud + 1 < this.cloud_first.length ? this.cloud_first[cloud + 1] : this.point_label.length;
    return [this.cloud_first[cloud], next];
  }
}

function quantile(numbers, share) {
  const sorted = Array.from(numbers).filter(Number.isFinite).sort((a, b) => a - b);
  return sorted.length ? sorted[Math.round(share * (sorted.length - 1))] : NaN;
}

// Zero has no sign.
function fixed(value, digits) { return value.toFixed(digits).replace(/^-(0(\.0*)?)$/, '$1'); }

function number_text(value, digits) { return Number.isFinite(value) ? fixed(value, digits) : '–'; }

function amount_text(recording, quantity, value) {
  if (!Number.isFinite(value)) return '–';
  return recording.is_angle(quantity) ? `${fixed(value, 3)}°` : `${fixed(value, 3)} m`;
}
