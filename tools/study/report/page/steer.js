// What may steer, as the first line says it: of a frame, or with shares of a recording. The causes come from the
// program (tools/study/steer), which says the same in `pose_wall run`, by MQTT and at /state.json.

function may_steer(f, q) { return recording.steer[recording.at(f, q)] >= recording.words.steer_causes.length; }

function steer_text(cause) { return recording.words.steer_texts[page.language][cause]; }

// Of one value, in degrees or m. share: NaN, for a frame is no share of anything.
function steering_of_value(f, q) {
  const i = recording.at(f, q), state = recording.state[i];
  return { q, may: may_steer(f, q), cause: recording.steer[i], share: NaN, limit: recording.alert(q),
    is_measured: state >= DEGRADED && Number.isFinite(recording.raw[i]), level: recording.bound_of(f, q) };
}

function steering_of(f) { return QUANTITIES.map((name, q) => steering_of_value(f, q)); }

// Once, where all are the same.
function each_once(texts) { return [...new Set(texts)].length === 1 ? texts[0] : words().listed(texts); }

// Those that have one cause.
function told_together(alike) {
  const w = words(), first = alike[0];
  const amount = (x) => (x.level > LIMITS_SHOWN * x.limit ? `> ${Number((LIMITS_SHOWN * x.limit).toPrecision(6))}${recording.is_angle(x.q) ? '°' : ' m'}` : amount_text(recording, x.q, x.level));
  const levels = Number.isNaN(first.level) ? w.no_bound : w.level_limit(each_once(alike.map(amount)), amount_text(recording, first.q, first.limit));
  const level = first.is_measured ? levels : w.not_measured;
  const often = Number.isFinite(first.share) ? w.of_frames(each_once(alike.map((x) => whole_percent(x.share))), level) : level;
  return w.with_cause(w.listed(alike.map((x) => w.names[QUANTITIES[x.q]])), often, steer_text(first.cause));
}

// { may, may_not, help }: sentences, the last two empty where there is nothing to say.
function steer_sentences(list) {
  const w = words(), groups = new Map(), names = list.filter((x) => x.may).map((x) => w.names[QUANTITIES[x.q]]);
  for (const x of list) {
    if (x.may) continue;
    const key = `${x.cause} ${x.is_measured} ${x.is_measured && recording.is_angle(x.q)}`;
    groups.set(key, [...(groups.get(key) || []), x]);
  }
  const remedies = new Set(list.filter((x) => !x.may).map((x) => recording.words.steer_remedies[page.language][x.cause]).filter((text) => text));
  return { may: w.may_steer(names.length ? w.listed(names) : w.none), may_not: groups.size ? w.may_not(w.joined([...groups.values()].map(told_together))) : '',
    help: remedies.size ? w.to_look_at(w.joined([...remedies])) : '' };
}

// Green: all may; red: none may; amber between.
function steer_grade(list) {
  if (list.every((x) => x.may)) return 'good';
  return list.some((x) => x.may) ? 'fair' : 'bad';
}
