// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A viewer that others wrote (@foxglove/ws-protocol). node foxglove_client.mjs URL PROTOCOL SECONDS HOW WANTED
// Subscribes to every channel, reads each message by its schema, and prints one line of JSON: what the server said and
// what was read. It ends after the seconds, or with WANTED, messages by topic ({"/a": 3}). HOW stall: it takes nothing
// from the first message on.
import wsProtocol from '@foxglove/ws-protocol'; // CommonJS
import WebSocket from 'ws';
import { ChannelReader } from './channel_reader.mjs';

const [url, protocol, seconds, how, wanted] = process.argv.slice(2);
const lacking = new Map(Object.entries(JSON.parse(wanted)));
const told = { protocol: '', server: null, statuses: [], channels: {}, orders: 0, closed_s: null, error: '' };
const readers = new Map();
let client, socket;

function end() {
  for (const { reader, channel } of readers.values()) told.channels[channel.topic] = reader.told;
  console.log(JSON.stringify(told));
  process.exit(0);
}

socket = new WebSocket(url, [protocol]);
client = new wsProtocol.FoxgloveClient({ ws: socket });
client.on('error', (fault) => { told.error = String(fault.message ?? fault); });
client.on('open', () => { told.protocol = socket.protocol; });
client.on('close', () => { told.closed_s = Date.now() / 1000; end(); });
client.on('serverInfo', (info) => { told.server = info; });
client.on('status', (status) => told.statuses.push(status));
client.on('advertise', (channels) => {
  // Readers take their time to be made; who subscribes and then takes nothing for seconds is ended.
  const made = channels.map((channel) => ({ channel, reader: new ChannelReader(channel), last: 0n }));
  for (const one of made) readers.set(client.subscribe(one.channel.id), one);
  console.error('subscribed');
  setTimeout(end, 1000 * Number(seconds));
});
client.on('message', ({ subscriptionId, timestamp, data }) => {
  const to = readers.get(subscriptionId);
  if (timestamp < to.last) ++told.orders;
  to.last = timestamp;
  to.reader.take(data);
  if (how === 'stall') socket.pause();
  const topic = to.channel.topic;
  if (lacking.get(topic) > to.reader.told.messages || !lacking.delete(topic)) return;
  if (!lacking.size) end();
});
setTimeout(end, 60000).unref(); // no server, no channels
