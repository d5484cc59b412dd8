'use strict';
// The texts of the page of a motion table in English and Chinese. Names of states, reasons and directions are those of
// pose_wall_motion.h. Both languages have the same keys: tests/checks/check_page_words.py compares them.

// By pose_wall_along_state; the last marks a frame that the library never saw.
const STATES = ['lost', 'unobservable', 'ambiguous', 'measured', 'unreadable'];
const MEASURED = 3;
const STATE_COLOURS = { lost: 'invalid', unobservable: 'held', ambiguous: 'degraded', measured: 'valid', unreadable: 'unreadable' };

const WORDS = {
  en: {
    other_language: '中文 (ZH)', theme: 'Dark / light', report: 'pose_wall motion report', frame: 'frame', frames_with: 'frames', share: 'share', state: 'state along the road',
    subtitle: (m) => `${m.frames} frame${m.frames === 1 ? '' : 's'}, pose_wall ${m.head.version}` + (m.head.truth ? `, compared with ${m.head.truth}` : ''),
    path_caption: 'The path from above in metres, in base of the first frame: x to the right, y up. Colour: state along the road. Dashed: truth. Click: go to the nearest frame.',
    series: 'Over time', series_help: 'Band: protection level, the bound of the error; no band where there is no bound. Colour bar below: state along the road. Click: go to the frame.',
    travel: 'travel along the road [m]', step: 'travel since the last frame [m]', summary: 'Summary', reasons: 'Reasons', reason: 'reason',
    truth: 'Compared with the truth', error: 'error', at_end: 'at the end', largest: 'largest', of_way: 'share of the way', beyond: 'poses above their level',
    drift: (t) => `Drift over 10 m: mean ${share_text(t.drift.mean)}, worst ${share_text(t.drift.worst)}`, no_drift: 'The way is shorter than 10 m.',
    misleading: (t) => `Measured, but with an error along the road above the level: ${t.misleading_poses.misleading} of ${t.misleading_poses.measured} poses, ` +
      `${t.misleading_steps.misleading} of ${t.misleading_steps.measured} steps.`,
    value: 'value', quantity: 'quantity', level: 'error at most', place: 'place x, y, z', time: 'time in the library',
    units: 'This page shows degrees and metres. The CSV of pose_wall motion holds radians and metres. Axes: x, y and z of base; a positive yaw turns left, as in ROS.',
    verdict_good: 'The travel along the road was measured nearly all the time.', verdict_fair: 'The travel along the road was measured in part.',
    verdict_bad: 'Not usable: the travel along the road was measured in less than half of the frames.',
    verdict_rule: 'Rule: measured nearly all the time means at least 95 % of the frames and none lost; measured in part, at least 50 %.',
    verdict_travel: (a, l) => `Travel along the road at the end: ${a}, ${l ? `error at most ${l}` : 'without a bound: do not rely on it'}.`,
    verdict_share: (s, n) => `${s}: ${n} of the frames.`,
    states: { measured: 'measured', ambiguous: 'ambiguous', unobservable: 'unobservable', lost: 'lost', unreadable: 'could not be read' },
    directions: { along: 'along', across: 'across', up: 'up', roll: 'roll', pitch: 'pitch', yaw: 'yaw', turn: 'turn' },
  },
  zh: {
    other_language: 'English (EN)', theme: '深色 / 浅色', report: 'pose_wall 运动报告', frame: '帧', frames_with: '帧数', share: '比例', state: '沿巷道方向的状态',
    subtitle: (m) => `${m.frames} 帧，pose_wall ${m.head.version}` + (m.head.truth ? `，与 ${m.head.truth} 对比` : ''),
    path_caption: '俯视轨迹，坐标系为第一帧的机体坐标系：x 向右，y 向上，单位 m；颜色表示沿巷道方向的状态。虚线：真值。单击跳到最近的帧。',
    series: '随时间变化', series_help: '色带：保护级，即误差上界；无界时不画。下方色条：沿巷道方向的状态。单击跳到该帧。',
    travel: '沿巷道行程 [m]', step: '相对上一帧的行程 [m]', summary: '汇总', reasons: '原因', reason: '原因',
    truth: '与真值对比', error: '误差', at_end: '终点', largest: '最大', of_way: '占行程', beyond: '超出保护级的位姿数',
    drift: (t) => `每 10 m 漂移：平均 ${share_text(t.drift.mean)}，最大 ${share_text(t.drift.worst)}`, no_drift: '行程不足 10 m。',
    misleading: (t) => `状态为“已测得”而沿巷道误差超出保护级：位姿 ${t.misleading_poses.misleading} / ${t.misleading_poses.measured}，` +
      `步长 ${t.misleading_steps.misleading} / ${t.misleading_steps.measured}。`,
    value: '值', quantity: '量', level: '误差上界', place: '位置 x, y, z', time: '计算时间',
    units: '本页角度单位为度，长度单位为米。pose_wall motion 的 CSV 为弧度与米。坐标轴为 base 的 x、y、z；航向为正表示左转，与 ROS 一致。',
    verdict_good: '沿巷道的行程几乎始终可测。', verdict_fair: '沿巷道的行程仅部分时间可测。', verdict_bad: '不可用：测得沿巷道行程的帧不到一半。',
    verdict_rule: '判定规则：至少 95 % 的帧测得且无丢失为“几乎始终可测”；至少 50 % 为“部分时间可测”。',
    verdict_travel: (a, l) => `结束时沿巷道行程：${a}，${l ? `误差不超过 ${l}` : '误差无界：不可依赖'}。`,
    verdict_share: (s, n) => `${s}：占 ${n}。`,
    states: { measured: '已测得', ambiguous: '不唯一', unobservable: '不可观测', lost: '丢失', unreadable: '无法读取' },
    directions: { along: '纵向', across: '横向', up: '竖向', roll: '横滚', pitch: '俯仰', yaw: '航向', turn: '转角' },
    reason_texts: {
      first: '地图从本帧开始。', few_points: '周围有完整表面的点过少。', few_matches: '落在地图表面上的点过少。',
      smooth: '岩面起伏不足以区分沿巷道的位置。', few_patches: '能确定位置的岩面块过少（如一个人、一根支柱）。',
      halves_differ: '岩面的两半给出不同的位置。', second_peak: '另一处位置几乎同样吻合。', at_edge: '最佳位置位于搜索范围的边缘。',
      no_ground: '仅由巷帮和顶板确定横滚、俯仰和高度。', stamp: '时间戳停滞或倒退：本帧不采用。', gap: '本帧之前缺帧：在大范围内搜索。',
      prior: '本帧的外部输入与测量矛盾，未采用。', map_full: '地图已满，最旧部分被最新部分取代。',
      repeated: '点云（或其一部分）与此前完全相同：传感器或驱动卡死，本帧不采用。', unreadable: '无法读取',
    },
  },
};
