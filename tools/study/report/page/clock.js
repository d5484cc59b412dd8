// Stamps as people read them: the time of day where the stamps are those of a clock, else seconds since the first frame.

const kClockFrom_s = 1e9;  // 2001: what is less counts from the start of a sensor or of a simulation
const kTicks_s = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 43200, 86400];

// Where nothing came yet a live page has stamps of 0. A recording without stamps begins at 0.
function first_stamp(recording) {
  const stamp_s = recording.stamp_s.subarray(0, recording.frames);
  const is_none = (s) => !(s > 0) && (recording.is_live || stamp_s[stamp_s.length - 1] >= kClockFrom_s);
  return Math.max(0, stamp_s.findIndex((s) => !is_none(s)));
}

function has_clock(recording) { return recording.stamp_s[first_stamp(recording)] >= kClockFrom_s; }

function moment_text(recording, stamp_s, digits = 0) {
  if (!Number.isFinite(stamp_s)) return '–';
  if (!has_clock(recording)) return `${fixed(stamp_s - recording.stamp_s[first_stamp(recording)], digits)} s`;
  if (stamp_s <= 0) return '–';
  const scale = 10 ** digits, whole = Math.floor(stamp_s * scale) / scale, at = new Date(1000 * Math.floor(whole)), two = (n) => String(n).padStart(2, '0');
  const part = digits ? (whole - Math.floor(whole)).toFixed(digits).slice(1) : '';
  return `${two(at.getHours())}:${two(at.getMinutes())}:${two(at.getSeconds())}${part}`;
}

function date_text(stamp_s) {
  const at = new Date(1000 * stamp_s), two = (n) => String(n).padStart(2, '0');
  return `${at.getFullYear()}-${two(at.getMonth() + 1)}-${two(at.getDate())}`;
}

// [frame, text] where a round time is passed; some `most` of them from one frame to another.
function clock_ticks(recording, from, to, most) {
  const stamp_s = recording.stamp_s, zero_s = has_clock(recording) ? 0 : stamp_s[first_stamp(recording)], out = [];
  const first = Math.max(first_stamp(recording), Math.ceil(from)), last = Math.min(recording.frames - 1, Math.floor(to)), span_s = Math.abs(stamp_s[last] - stamp_s[first]);
  const step_s = kTicks_s.find((step) => step >= span_s / Math.max(1, most)) || span_s;
  const count = (f) => Math.floor((stamp_s[f] - zero_s) / step_s + 1e-6);
  for (let f = first + 1; f <= last && out.length < 2 * most; ++f) {
    if (count(f) > count(f - 1)) out.push([f, moment_text(recording, zero_s + count(f) * step_s, step_s < 1 ? 1 : 0)]);
  }
  return out;
}
