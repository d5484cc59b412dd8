// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A viewer that others wrote (@foxglove/ws-protocol). node foxglove_client.mjs URL PROTOCOL SECONDS [stall]
// Subscribes to every channel, reads each message by its schema, and prints one line of JSON: what the server said and
// what was read. stall: takes nothing from the first messages on.
import { FoxgloveClient } from '@foxglove/ws-protocol';
import WebSocket from 'ws';
import { ChannelReader } from './channel_reader.mjs';

const [url, protocol, seconds, how] = process.argv.slice(2);
const told = { protocol: '', server: null, statuses: [], channels: {}, orders: 0, late_ms: 0, closed_s: null, error: '' };
const readers = new Map();
let client, socket;

function end() {
  for (const { reader, channel } of readers.values()) told.channels[channel.topic] = reader.told;
  console.log(JSON.stringify(told));
  process.exit(0);
}

socket = new WebSocket(url, [protocol]);
client = new FoxgloveClient({ ws: socket });
client.on('error', (fault) => { told.error = String(fault.message ?? fault); });
client.on('open', () => { told.protocol = socket.protocol; });
client.on('close', () => { told.closed_s = Date.now() / 1000; end(); });
client.on('serverInfo', (info) => { told.server = info; });
client.on('status', (status) => told.statuses.push(status));
client.on('advertise', (channels) => {
  for (const channel of channels) {
    const id = client.subscribe(channel.id);
    readers.set(id, { channel, reader: new ChannelReader(channel), last: 0n });
  }
  console.error('subscribed');
});
client.on('message', ({ subscriptionId, timestamp, data }) => {
  const to = readers.get(subscriptionId);
  if (timestamp < to.last) ++told.orders;
  to.last = timestamp;
  told.late_ms = Math.max(told.late_ms, Date.now() - Number(timestamp / 1000000n));
  to.reader.take(data);
  if (how === 'stall') socket.pause();
});
setTimeout(end, 1000 * Number(seconds));
