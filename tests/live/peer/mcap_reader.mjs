// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A reader of MCAP that others wrote (@mcap/core): what it gets out of a file, cut or whole. node mcap_reader.mjs FILE...
// Prints one line of JSON a file: messages by topic, chunks, whether it is whole, and how many results are sound JSON.
import { readFileSync } from 'node:fs';
import mcap from '@mcap/core'; // CommonJS
import { ChannelReader } from './channel_reader.mjs';

const { McapIndexedReader, McapStreamReader } = mcap;

// The file in memory as the reader asks for it.
function inMemory(bytes) {
  return {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
  };
}

// Chunks come as they lie there (with their checksums tested), then their messages.
function stream(bytes) {
  const told = { topics: {}, schemas: {}, results: 0, chunks: 0, fault: '' };
  const reader = new McapStreamReader({ validateCrcs: true, includeChunks: true });
  const channels = new Map(), schemas = new Map();
  try {
    reader.append(bytes);
    for (let record; (record = reader.nextRecord());) {
      if (record.type === 'Chunk') ++told.chunks;
      if (record.type === 'Schema') schemas.set(record.id, record.name);
      if (record.type === 'Channel') channels.set(record.id, record);
      if (record.type !== 'Message') continue;
      const channel = channels.get(record.channelId);
      told.topics[channel.topic] = (told.topics[channel.topic] ?? 0) + 1;
      told.schemas[channel.topic] = schemas.get(channel.schemaId);
      if (channel.messageEncoding === 'json') {
        const read = JSON.parse(new TextDecoder().decode(record.data));
        if (channel.topic === '/pose_wall/result' && Number.isInteger(read.publication)) ++told.results;
      }
    }
  } catch (fault) {
    told.fault = String(fault.message);
  }
  told.whole = reader.done();
  return told;
}

// By the summary and the indexes of messages, as Foxglove opens a file. There is none of a file that was cut.
async function byIndex(bytes) {
  const reader = await McapIndexedReader.Initialize({ readable: inMemory(bytes) });
  const told = { statistics: Number(reader.statistics.messageCount), chunks: reader.chunkIndexes.length, messages: 0 };
  let last = 0n;
  for await (const message of reader.readMessages()) {
    if (message.logTime < last) throw new Error('not in the order of time');
    last = message.logTime;
    ++told.messages;
  }
  told.members = {}; // by the schema, as a viewer lists them
  const readers = new Map();
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    const text = new TextDecoder().decode(schema.data);
    readers.set(channel.id, new ChannelReader({ topic: channel.topic, encoding: channel.messageEncoding, schema: text,
      schemaName: schema.name, schemaEncoding: schema.encoding }));
    if (schema.encoding === 'jsonschema') told.members[channel.topic] = Object.keys(JSON.parse(text).properties);
  }
  for await (const message of reader.readMessages()) readers.get(message.channelId).take(message.data);
  told.read = {}; // each message by its schema
  for (const channel of reader.channelsById.values()) told.read[channel.topic] = readers.get(channel.id).told;
  return told;
}

for (const file of process.argv.slice(2)) {
  const bytes = new Uint8Array(readFileSync(file));
  const told = stream(bytes);
  try {
    told.index = await byIndex(bytes);
  } catch (fault) {
    told.index = null;
    told.noIndex = String(fault.message).slice(0, 200);
  }
  console.log(JSON.stringify(told));
}
