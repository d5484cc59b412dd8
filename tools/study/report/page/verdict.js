// Sums up the recording in numbers; the page puts them into words. The rule of tools/study/results/usability.hpp, whose
// shares the head holds, grades values and recording.

// By the most frequent cause, as the rule of tools/study/steer/steer_tally.cpp. causes: of each its frames.
function steer_of_all(q, causes, share) {
  const [cause, frames] = [...causes].sort((a, b) => b[1].length - a[1].length || a[0] - b[0])[0] || [0, []];
  const levels = frames.map((f) => steering_of_value(f, q)).filter((x) => x.is_measured && !Number.isNaN(x.level)).map((x) => x.level);
  return { q, cause, share, limit: recording.alert(q), is_measured: 2 * levels.length > frames.length, level: quantile(levels, 0.5) };
}

function summarise(recording) {
  const readable = [];
  for (let f = 0; f < recording.frames; ++f) if (!recording.error[f]) readable.push(f);
  const quantities = QUANTITIES.map((name, q) => {
    const states = [0, 0, 0, 0], reasons = new Map(), steered = new Map();
    const values = [], levels = [], raw_levels = [], parts = recording.words.parts.map(() => []);
    const how_often = parts.map(() => 0);
    let squares = 0, errors = 0, largest = 0, beyond = 0, misleading = 0;
    for (const f of readable) {
      const i = recording.at(f, q), state = recording.state[i];
      ++states[state];
      if (!may_steer(f, q)) {
        if (!steered.has(recording.steer[i])) steered.set(recording.steer[i], []);
        steered.get(recording.steer[i]).push(f);
      }
      if (state !== 3) for (const bit of recording.reason_bits(recording.reasons[i])) reasons.set(bit, (reasons.get(bit) || 0) + 1);
      if (state === 0) continue;
      values.push(recording.value[i] * recording.unit(q));
      levels.push(recording.level[i] * recording.unit(q));
      raw_levels.push(recording.raw_level[i] * recording.unit(q));
      if (recording.has_level(f, q)) {
        recording.parts(f, q).forEach((part, k) => parts[k].push(part * recording.unit(q)));
        ++how_often[recording.cause[i]];
      }
      const error = Math.abs(recording.error_of(f, q));
      // Valid where there is nothing to measure misleads, too.
      if (recording.has_truth && state === 3 && !(error <= recording.alert(q))) ++misleading;
      if (!Number.isFinite(error)) continue;
      ++errors;
      squares += error * error;
      largest = Math.max(largest, error);
      if (!(error <= recording.level[i] * recording.unit(q))) ++beyond;
    }
    const top = [...reasons].sort((a, b) => b[1] - a[1] || a[0] - b[0]);
    const most = Math.max(...how_often);
    const made_of = { name, q, level: quantile(levels, 0.5), raw_level: quantile(raw_levels, 0.5),
      parts: parts.map((numbers) => quantile(numbers, 0.5)), cause: most ? how_often.indexOf(most) : parts.length,
      often: most / Math.max(1, parts[0].length) };
    const valid_share = readable.length ? states[3] / readable.length : 0;
    return { name, q, states, reasons: top, made_of, steer: steer_of_all(q, steered, valid_share), median: quantile(values, 0.5), level: quantile(levels, 0.5),
      errors, rmse: Math.sqrt(squares / errors), largest: errors ? largest : NaN, beyond, misleading,
      valid: valid_share };
  });
  const sum = (member) => quantities.reduce((total, x) => total + x[member], 0);
  const valid = quantities.reduce((total, x) => total + x.states[3], 0);
  return { readable, unreadable: recording.frames - readable.length, quantities, misleading: sum('misleading'),
    valid, beyond: sum('beyond'), ...grade_of(quantities, recording.head, sum('misleading'), sum('beyond'), readable.length) };
}

// Of one value: 'usable', 'in_part' or 'not_usable'.
function use_of(valid_share, head) {
  if (valid_share >= head.usable_share) return 'usable';
  return valid_share >= head.in_part_share ? 'in_part' : 'not_usable';
}

// Of the recording: its colour, and which words head the verdict.
function grade_of(quantities, head, misleading, beyond, readable) {
  const uses = quantities.map((x) => use_of(x.valid, head));
  if (!readable) return { grade: 'bad', headline: 'verdict_none' };
  if (misleading > 0) return { grade: 'bad', headline: 'verdict_wrong' };
  if (uses.every((use) => use === 'not_usable')) return { grade: 'bad', headline: 'verdict_bad' };
  if (uses.some((use) => use !== 'usable')) return { grade: 'fair', headline: 'verdict_fair' };
  return beyond ? { grade: 'fair', headline: 'verdict_beyond_fair' } : { grade: 'good', headline: 'verdict_good' };
}

// Steps between stamps: the usual rate, and how often one was more than half a step late.
function stamp_health(recording) {
  const steps = [];
  for (let f = 1; f < recording.frames; ++f) steps.push(recording.stamp_s[f] - recording.stamp_s[f - 1]);
  const usual = quantile(steps, 0.5);
  return { rate: 1 / usual, gaps: steps.filter((step) => !(step > 0 && step < 1.5 * usual)).length };
}
