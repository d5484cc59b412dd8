// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A client of ROS 1 that others wrote (@foxglove/ros1): publishes clouds of a simulated road and reads what pose_walld
// makes of them. node ros1_client.mjs MASTER_URI TOPIC COLUMNS RATE_HZ CLOUDS
// Prints one line of JSON: how many were sent, came back, and how late.
import { RosNode } from '@foxglove/ros1';
import { getPid, TcpServerNode, TcpSocketNode } from '@foxglove/ros1/nodejs';
import { HttpServerNodejs } from '@foxglove/xmlrpc/nodejs';

const [masterUri, topic, columns, rate, clouds] = process.argv.slice(2).map((word, i) => (i > 1 ? Number(word) : word));
const STEP = 32, RINGS = 64;

// A road 5 m wide, seen from 1.2 m above its floor, the machine `aside` metres to the left of its middle.
function road(aside) {
  const points = [];
  for (let ring = 0; ring < RINGS; ++ring) {
    for (let column = 0; column < columns; ++column) {
      const e = (-45 + 90 * ring / (RINGS - 1)) * Math.PI / 180, a = 2 * Math.PI * column / columns;
      const x = Math.cos(e) * Math.cos(a), y = Math.cos(e) * Math.sin(a), z = Math.sin(e);
      const side = y > 0 ? (2.5 - aside) / y : (2.5 + aside) / -y;
      const range = Math.min(side, z > 0 ? 2.0 / z : z < 0 ? 1.2 / -z : 1e9);
      points.push(range > 25 ? [0, 0, 0] : [range * x, range * y, range * z]);
    }
  }
  const data = new Uint8Array(points.length * STEP), view = new DataView(data.buffer);
  points.forEach((p, i) => p.forEach((v, k) => view.setFloat32(i * STEP + 4 * k, v, true)));
  return { data, count: points.length };
}

const scene = road(0);
const node = new RosNode({ name: '/pose_wall_peer', rosMasterUri: masterUri, hostname: '127.0.0.1', pid: getPid(),
  httpServer: new HttpServerNodejs(),
  tcpSocketCreate: TcpSocketNode.Create, tcpServer: await TcpServerNode.Listen({ host: '127.0.0.1' }) });
await node.start();

const definition = [
  { name: 'header', type: 'std_msgs/Header', isComplex: true }, { name: 'height', type: 'uint32' }, { name: 'width', type: 'uint32' },
  { name: 'fields', type: 'sensor_msgs/PointField', isArray: true, isComplex: true }, { name: 'is_bigendian', type: 'bool' },
  { name: 'point_step', type: 'uint32' }, { name: 'row_step', type: 'uint32' }, { name: 'data', type: 'uint8', isArray: true }, { name: 'is_dense', type: 'bool' }];
const messageDefinition = [{ definitions: definition },
  { name: 'std_msgs/Header', definitions: [{ name: 'seq', type: 'uint32' }, { name: 'stamp', type: 'time' }, { name: 'frame_id', type: 'string' }] },
  { name: 'sensor_msgs/PointField', definitions: [{ name: 'INT8', type: 'uint8', isConstant: true, value: 1, valueText: '1' }, { name: 'UINT8', type: 'uint8', isConstant: true, value: 2, valueText: '2' },
    { name: 'INT16', type: 'uint8', isConstant: true, value: 3, valueText: '3' }, { name: 'UINT16', type: 'uint8', isConstant: true, value: 4, valueText: '4' },
    { name: 'INT32', type: 'uint8', isConstant: true, value: 5, valueText: '5' }, { name: 'UINT32', type: 'uint8', isConstant: true, value: 6, valueText: '6' },
    { name: 'FLOAT32', type: 'uint8', isConstant: true, value: 7, valueText: '7' }, { name: 'FLOAT64', type: 'uint8', isConstant: true, value: 8, valueText: '8' },
    { name: 'name', type: 'string' }, { name: 'offset', type: 'uint32' }, { name: 'datatype', type: 'uint8' }, { name: 'count', type: 'uint32' }] }];
await node.advertise({ topic, dataType: 'sensor_msgs/PointCloud2', latching: false, messageDefinition,
  messageDefinitionText: '', md5sum: '1158d486dd51d683ce2f1be655c3c181' });

const sent = new Map(), latencies = [], states = [], distances = [];
const key = (stamp) => `${stamp.sec}.${stamp.nsec}`;
const attitudes = node.subscribe({ topic: '/pose_wall/attitude', dataType: 'geometry_msgs/Vector3Stamped' });
attitudes.on('message', (message) => {
  const at = sent.get(key(message.header.stamp));
  if (at !== undefined) { latencies.push(performance.now() - at); sent.delete(key(message.header.stamp)); }
});
node.subscribe({ topic: '/pose_wall/state', dataType: 'pose_wall_msgs/State' }).on('message', (message) => states.push(message));
node.subscribe({ topic: '/pose_wall/distances', dataType: 'std_msgs/Float32MultiArray' }).on('message', (message) => distances.push(message));

const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const matched_by = Date.now() + 20000;
while (Date.now() < matched_by && !latencies.length) {
  await publish(0);  // until the daemon has found us and we have found it
  await sleep(200);
}
const before = latencies.length;
sent.clear();
latencies.length = 0;

async function publish(i) {
  const now = Date.now(), stamp = { sec: Math.floor(now / 1000), nsec: (now % 1000) * 1000000 + (i % 1000) };
  const { data, count } = scene, floats = new Float32Array(data.buffer);
  // A cloud that was there before is a frozen sensor's: each is moved by a tenth of a millimetre.
  for (let k = 0; k < count; ++k) if (floats[8 * k]) floats[8 * k + 1] += 1e-4;
  const field = (name, offset) => ({ name, offset, datatype: 7, count: 1 });
  sent.set(key(stamp), performance.now());
  await node.publish(topic, { header: { seq: i, stamp, frame_id: 'lidar' }, height: 1, width: count, fields: [field('x', 0), field('y', 4), field('z', 8)],
    is_bigendian: false, point_step: STEP, row_step: STEP * count, data, is_dense: false });
}

const began = performance.now();
for (let i = 0; i < clouds; ++i) {
  await publish(i + 1);
  await sleep(Math.max(0, began + (i + 1) * 1000 / rate - performance.now()));
}
await sleep(1000);
latencies.sort((a, b) => a - b);
const last = states[states.length - 1], last_distances = distances.filter((message) => message.data.every(Number.isFinite)).pop();  // silence follows the last cloud
console.log(JSON.stringify({ connected: before > 0, bytes: scene.data.length, sent: clouds, received: latencies.length,
  median_ms: latencies[latencies.length >> 1], worst_ms: latencies[latencies.length - 1], states: states.length,
  names: last?.values.map((value) => value.name), label: last_distances?.layout.dim[0]?.label, distances: Array.from(last_distances?.data ?? []) },
  (_, value) => (typeof value === 'bigint' ? Number(value) : value)));
node.shutdown();
process.exit(0);
