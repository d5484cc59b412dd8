#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 the pose_wall authors
#
# node-opcua-server 2.176.0 (npm) names no version of Node.js. On Node.js 18, Debian 12's, it starts and listens. The first
# client that asks for a session ends its process: "no cryptographically secure random source available:
# globalThis.crypto.getRandomValues is missing. A browser or Node.js 18 or later is required". Node.js 18 has that object
# as webcrypto of node:crypto, and global only with --experimental-global-webcrypto; global from 19 on.
# Guess before: what starts and listens on a version of Node.js serves there.
# What follows: on Debian 12 a server sets globalThis.crypto itself before it loads the library. Its dependency hexy 0.4 is
# a module that Node.js 18 cannot require; 0.3.5 can be.
#
# Needs node 18 or 20, and npm. Later ones are told to leave the global away. Everything lies in a temporary folder. Exit 0:
# as told here.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
echo '{"private": true, "overrides": {"hexy": "0.3.5"}}' > package.json
npm install --no-audit --no-fund node-opcua-server@2.176.0 > log 2>&1 || { cat log; exit 2; }

cat > server.cjs << 'JS'
if (process.argv[2] === "set") globalThis.crypto ??= require("node:crypto").webcrypto;
const { OPCUAServer } = require("node-opcua-server");
(async () => {
  const server = new OPCUAServer({ port: 48480, host: "127.0.0.1", hostname: "127.0.0.1" });
  await server.start();
  require("node:fs").writeFileSync("listens", "");
})();
JS
cat > client.cjs << 'JS'
globalThis.crypto ??= require("node:crypto").webcrypto;
const { OPCUAClient } = require("node-opcua-client");
(async () => {
  const client = OPCUAClient.create({ endpointMustExist: false, connectionStrategy: { maxRetry: 0 } });
  try {
    await client.connect("opc.tcp://127.0.0.1:48480");
    await client.createSession();
    console.log("a session");
  } catch { console.log("no session"); }
  process.exit(0);
})();
JS
for how in leave set; do
  rm -f listens
  XDG_CONFIG_HOME=$work HOME=$work node --no-experimental-global-webcrypto server.cjs $how > "$how.log" 2>&1 &
  server=$!
  for _ in $(seq 600); do [ -e listens ] && break; sleep 0.1; done
  [ -e listens ] && printf '%s: listens, ' "$how"
  HOME=$work timeout 60 node client.cjs 2> /dev/null | grep session | tr '\n' ','
  sleep 2
  if kill -9 "$server" 2> /dev/null; then echo " lives"; else echo " has ended: $(grep -o 'crypto.getRandomValues is missing' "$how.log" | head -n 1)"; fi
  wait "$server" 2> /dev/null || :
done | tee seen
cat > expected << 'SEEN'
leave: listens, no session, has ended: crypto.getRandomValues is missing
set: listens, a session, lives
SEEN
cmp seen expected
