'use strict';
// What the page says, in English and Chinese. Names of quantities, states and reasons are those of pose_wall.h.

const QUANTITIES = ['roll', 'pitch', 'yaw', 'd_lf', 'd_lb', 'd_rf', 'd_rb'];
// By pose_wall_state; the last is not the engine's: a frame that it never saw.
const STATES = ['invalid', 'held', 'degraded', 'valid', 'unreadable'], UNREADABLE = 4;

const WORDS = {
  en: {
    other_language: '中文 (ZH)', theme: 'Dark / light', play: '▶ Play', pause: '❚❚ Pause',
    subtitle: (r) => `${count(r.frames, 'frame')}, pose_wall ${r.head.version}` +
      (r.head.truth ? `, compared with ${r.head.truth}` : ''),
    interrupted: (r) => `Interrupted: ${r.frames} of ${r.head.inputs} frames are shown.`,
    layers: ['other points', 'floor', 'left wall', 'right wall', 'dropped (range, body)'], planes: 'planes', boxes: 'body boxes',
    top_caption: 'From above, the road to the right; machine, planes and lines are drawn by raw, as this frame alone measured, and named so; what is held is named by its state. Thick: wall from first to last inlier. Wheel: zoom, drag: move, double click: back.',
    section_caption: 'Across the road at the machine (± 1.5 m), looking ahead; drawn by raw, too.',
    no_cloud: (f) => `The points shown are those of frame ${f}; planes and values are this frame's.`,
    series: 'The seven values over time',
    series_help: 'Line: the value to act on. Band: its protection level, cut at the frame. Dotted: the alert limit about the value. Below: the state. Dashed: the truth. A click goes to the frame; the wheel zooms in time.',
    summary: 'Summary', settings: 'Settings that are not the defaults', all_default: 'All settings are the defaults.',
    key: 'key', set_to: 'value', default_is: 'default',
    value: 'value (smoothed or held)', state: 'state', level: 'its protection level', raw: 'raw (this frame alone)', raw_level: 'its level',
    sigma: 'standard deviation', age: 'age', why: 'why', truth: 'truth', error: 'error',
    made_of: 'What the protection levels are made of', made_of_median: 'What the protection levels are made of: medians of the frames that have one',
    of_value: 'of the value', of_raw: 'of raw', mostly: 'mostly', mostly_often: (part, share) => `${part} (largest in ${share})`,
    lag_why: 'smoothing: the value lags behind this frame, by the largest part of its level',
    positive: (name, sense) => `${name} (+ ${sense})`,
    parts: { random: 'random', range_bias: 'range bias', bend: 'bend', rival: 'rival', extrapolation: 'extrapolation', lag: 'lag', age: 'age' },
    median: 'median', median_level: 'median level', rmse: 'RMSE', max_error: 'largest error', beyond: 'beyond level',
    misleading: 'misleading', reasons: 'Why values were not valid', frames_with: 'frames', reason: 'reason',
    times: 'Time elapsed (other work of the machine included)', engine: 'engine, one frame', p50: 'median', p99: '99 %', worst: 'worst', stage: 'stage',
    rate: 'frames per second', gaps: 'gaps between stamps',
    unreadable: 'could not be read', frame: 'frame', counts: (c) => `${c[0]} points in, dropped: ${c[1]} not finite, ` +
      `${c[2]} at the sensor, ${c[3]} too near, ${c[4]} too far, ${c[5]} on the machine; ${c[6]} voxels, ${c[7]} outliers, ` +
      `${c[8]} floor candidates, ${c[9]} in the wall band`,
    verdict_good: 'Every value could be used nearly all the time.',
    verdict_fair: 'Usable in part: some values were often not valid.',
    verdict_bad: 'Not usable as it is.',
    verdict_misleading: (n) => `${count(n, 'time')} a value claimed to be valid and was further off than the alert limit.`,
    verdict_no_misleading: (n) => (n ? `None of ${count(n, 'valid value')} was further off than the alert limit.` : 'No value was valid.'),
    verdict_beyond: (n) => `${count(n, 'value')} beyond the protection level.`,
    verdict_value: (q, valid, usable, level, limit, why) => `${q} ${valid ? `valid in ${valid}` : 'never valid'}, valid or degraded in ${usable}; ` +
      `median protection level ${level}, alert limit ${limit}` + (why ? `; most often because: ${why}` : ''),
    verdict_unreadable: (n) => `${count(n, 'frame')} could not be read.`,
    verdict_no_truth: 'There is no truth to compare with: the verdict speaks of states only.',
    names: { roll: 'roll', pitch: 'pitch', yaw: 'yaw', d_lf: 'left front', d_lb: 'left back', d_rf: 'right front', d_rb: 'right back' },
    states: { valid: 'valid', degraded: 'degraded', held: 'held', invalid: 'invalid', unreadable: 'unreadable' }, drawn_raw: 'raw',
  },
  zh: {
    other_language: 'English (EN)', theme: '深色 / 浅色', play: '▶ 播放', pause: '❚❚ 暂停',
    subtitle: (r) => `${r.frames} 帧，pose_wall ${r.head.version}` + (r.head.truth ? `，与 ${r.head.truth} 对比` : ''),
    interrupted: (r) => `处理被中断：显示 ${r.head.inputs} 帧中的 ${r.frames} 帧。`,
    layers: ['其他点', '地面', '左墙', '右墙', '被滤除（距离、机身）'], planes: '平面', boxes: '机身滤除框',
    top_caption: '俯视图，巷道方向向右；机器、平面与连线按原始值（仅本帧测得）绘制并注明，保持的值注明其状态。粗线：墙面首末内点之间。滚轮缩放，拖动平移，双击复位。',
    section_caption: '机身处横断面（± 1.5 m），面向前方；同样按原始值绘制。',
    no_cloud: (f) => `图中点云为第 ${f} 帧；平面与数值为当前帧。`,
    series: '七个输出随时间变化',
    series_help: '线：供控制使用的值。色带：保护级（超出图框部分被裁去）。点线：以该值为中心的告警限。下方色条：状态。虚线：真值。单击跳到该帧；滚轮缩放时间轴。',
    summary: '汇总', settings: '与默认值不同的参数', all_default: '全部参数均为默认值。',
    key: '参数', set_to: '取值', default_is: '默认',
    value: '值（平滑或保持）', state: '状态', level: '其保护级', raw: '原始值（仅本帧）', raw_level: '其保护级', sigma: '标准差', age: '时龄',
    why: '原因', truth: '真值', error: '误差',
    made_of: '保护级的构成', made_of_median: '保护级的构成：有保护级的各帧的中位数', of_value: '输出值', of_raw: '原始值', mostly: '主要成分',
    mostly_often: (part, share) => `${part}（${share} 的帧中最大）`, lag_why: '平滑：输出值滞后于本帧，且为保护级的最大成分',
    positive: (name, sense) => `${name}（正：${sense}）`,
    parts: { random: '随机误差', range_bias: '测距偏差', bend: '弯曲', rival: '竞争平面', extrapolation: '外推', lag: '平滑滞后', age: '时龄' },
    senses: { unknown: '未知', 'right side down': '右侧下倾', 'left side down': '左侧下倾', 'nose down': '机头下俯', 'nose up': '机头上仰', 'turned right': '机头偏向巷道右侧' },
    median: '中位数', median_level: '保护级中位数', rmse: '均方根误差', max_error: '最大误差', beyond: '超出保护级',
    misleading: '误导', reasons: '非有效的原因', frames_with: '帧数', reason: '原因',
    times: '耗时（含机器上其他任务）', engine: '引擎，每帧', p50: '中位数', p99: '99 %', worst: '最大', stage: '阶段',
    rate: '帧率（帧/秒）', gaps: '时间戳间断次数',
    unreadable: '无法读取', frame: '帧', counts: (c) => `输入 ${c[0]} 点；滤除：非数 ${c[1]}，零点 ${c[2]}，过近 ${c[3]}，过远 ${c[4]}，` +
      `机身 ${c[5]}；体素 ${c[6]}，离群 ${c[7]}，地面候选 ${c[8]}，墙带 ${c[9]}`,
    verdict_good: '全部输出几乎始终可用。',
    verdict_fair: '可用，但部分输出经常不是“有效”。',
    verdict_bad: '当前状态下不可用。',
    verdict_misleading: (n) => `有 ${n} 次输出标为有效，但误差超过告警限。`,
    verdict_no_misleading: (n) => (n ? `${n} 个有效值中没有任何一个误差超过告警限。` : '没有任何值为有效。'),
    verdict_beyond: (n) => `${n} 个值超出保护级。`,
    verdict_value: (q, valid, usable, level, limit, why) => `${q} ${valid ? `有效率 ${valid}` : '从未有效'}，有效或降级 ${usable}；` +
      `保护级中位数 ${level}，告警限 ${limit}` + (why ? `；最常见原因：${why}` : ''),
    verdict_unreadable: (n) => `${n} 帧无法读取。`,
    verdict_no_truth: '没有真值可供对比：结论仅依据状态。',
    names: { roll: '横滚', pitch: '俯仰', yaw: '航向', d_lf: '左前', d_lb: '左后', d_rf: '右前', d_rb: '右后' },
    states: { valid: '有效', degraded: '降级', held: '保持', invalid: '无效', unreadable: '无法读取' }, drawn_raw: '原始',
    reason_texts: {
      no_points: '滤波后点数不足', leaf_grown: '体素被放大以不超过 points_max', stamp_still: '时间戳与上一帧相同',
      stamp_back: '时间戳倒退', stamp_leap: '时间戳向前跳变', frozen: '点云与上一帧完全相同：传感器冻结',
      floor_not_found: '传感器下方没有可作地面的平面', floor_few_inliers: '地面内点不足',
      floor_thin: '地面点近于一条线或面积过小', floor_ambiguous: '另一高度或坡度同样能解释地面',
      wall_not_found: '该侧未找到墙面', wall_few_inliers: '墙面内点不足', wall_short: '墙面沿巷道支撑长度不足',
      wall_leans: '墙面倾斜过大', wall_seen_through: '应为实体处有射线穿过：管路、立柱、输送机、车辆或风帘',
      wall_ambiguous: '该侧另一平面同样能解释', walls_not_parallel: '两侧墙不平行', yaw_out_of_range: '航向超出 yaw_max_deg',
      cross_road: '横向存在更好的墙对', curved: '墙面或地面明显弯曲', extrapolated: '采样点处未见墙面，由平面外推',
      level_missing: '本帧无地面，未搜索墙面', alert_limit: '保护级超过告警限', innovation: '跳变超过机器可能的运动',
      rate_limited: '航向平滑受速率限制', hold_expired: '保持超时、保护级超限，或时间戳无法说明其时效', wall_too_near: '过近的回波遮挡该侧',
      never_measured: '从未测得', no_frame: '此后没有新的帧', work_limit: '本帧计算量已达 work_max，此项未完成',
      prior: '未采用本帧的机器输入：相互矛盾或与测量矛盾',
    },
  },
};

function count(n, thing) { return `${n} ${thing}${n === 1 ? '' : 's'}`; }
