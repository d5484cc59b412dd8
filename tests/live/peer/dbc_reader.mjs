// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A reader of DBC that others wrote (candied): what it makes of frames. node dbc_reader.mjs FILE.dbc, frames as "ID#DATA"
// on standard input, one a line; prints a line of JSON for each: message, and raw and physical value of every signal.
import { readFileSync } from 'node:fs';
import { Can, Dbc } from 'candied';

const kLong = 2 ** 31; // what DBC sets in an identifier of 29 bits
const can = new Can();
can.database = new Dbc().load(readFileSync(process.argv[2], 'utf8'));
for (const line of readFileSync(0, 'utf8').split('\n').filter(Boolean)) {
  const [id, data] = line.split('#');
  const isLong = id.length > 3;
  const bytes = data.match(/../g).map((byte) => parseInt(byte, 16));
  const message = can.decode(can.createFrame(parseInt(id, 16) + (isLong ? kLong : 0), bytes, isLong));
  const signals = {};
  for (const [name, signal] of message?.boundSignals ?? []) signals[name] = [signal.rawValue, signal.value, signal.physValue];
  console.log(JSON.stringify({ message: message?.name ?? null, signals }));
}
