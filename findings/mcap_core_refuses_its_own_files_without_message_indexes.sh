#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# McapWriter of @mcap/core 2.2.2 (npm) writes a file without message indexes where it is told to: useMessageIndex false,
# chunk indexes as always. Its McapStreamReader reads all messages of it. Its McapIndexedReader refuses the file with
# "Encountered a chunk index without message indexes and non-zero start and end times".
# Guess before: message indexes are optional by the format, so the indexed reader goes through the chunk instead.
# What follows: a recording is at hand for viewers in a browser only with a message index behind each chunk.
#
# Needs node 18 or later, and npm. Everything lies in a temporary folder. Exit 0: as told here.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm init -y > log 2>&1 && npm install --no-audit --no-fund @mcap/core@2.2.2 > log 2>&1 || { cat log; exit 2; }

cat > try.mjs << 'JS'
import { readFileSync } from "node:fs";
import { McapIndexedReader, McapStreamReader, McapWriter, TempBuffer } from "@mcap/core";

console.log("version", JSON.parse(readFileSync("node_modules/@mcap/core/package.json")).version);
const topic = { schemaId: 0, topic: "/t", messageEncoding: "json", metadata: new Map() };
for (const useMessageIndex of [true, false]) {
  const file = new TempBuffer();
  const writer = new McapWriter({ writable: file, useMessageIndex });
  await writer.start({ profile: "", library: "" });
  const channelId = await writer.registerChannel(topic);
  for (const time of [1n, 2n, 3n]) {
    const data = new TextEncoder().encode("{}");
    await writer.addMessage({ channelId, sequence: 0, logTime: time, publishTime: time, data });
  }
  await writer.end();

  const stream = new McapStreamReader();
  stream.append(file.get());
  let streamed = 0;
  for (let record; (record = stream.nextRecord()); ) streamed += record.type === "Message" ? 1 : 0;
  let indexed = 0;
  try {
    const reader = await McapIndexedReader.Initialize({ readable: file });
    for await (const message of reader.readMessages()) indexed += message.data.length > 0 ? 1 : 0;
  } catch (fault) {
    indexed = fault.message;
  }
  console.log(`message indexes ${useMessageIndex}: stream ${streamed}; indexed ${indexed}`);
}
JS
node try.mjs | tee seen
cat > expected << 'SEEN'
version 2.2.2
message indexes true: stream 3; indexed 3
message indexes false: stream 3; indexed Encountered a chunk index without message indexes and non-zero start and end times
SEEN
cmp seen expected
