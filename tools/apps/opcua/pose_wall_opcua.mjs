#!/usr/bin/env node
// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// An OPC UA server beside pose_walld. README.md has the information model, the status codes and their reasons.
import { webcrypto } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { isIP } from 'node:net';
import { hostname } from 'node:os';
import { join, resolve } from 'node:path';
import { parseArgs } from 'node:util';

import { Document, healthIsSound, stateIsSound, stopIsSound } from './daemon.mjs';

const HELP = `usage: pose_wall_opcua [OPTION]...

Serves what pose_walld measures to clients of OPC UA. Read only: it cannot change anything.
Start pose_walld with its page (http: 127.0.0.1:8080), then this beside it:

  pose_wall_opcua                                       # opc.tcp://127.0.0.1:4840, this machine alone, for a first try
  pose_wall_opcua --host 192.168.1.100 --user plant --password-file /etc/pose_wall/opcua_password

Look at Objects/PoseWall. A value is Good only if it may steer. Degraded and held values are Uncertain. Invalid ones are
Bad, and so is everything within a second when the daemon is silent. A controller must look at the status code.

  --daemon URL           the page of pose_walld                                (http://127.0.0.1:8080)
  --daemon-ca FILE       with https: the certificate that the page shows, or that of who signed it (PEM)
  --daemon-login FILE    where the page asks for a login (http_login): NAME:PASSWORD, the first line of FILE
  --host ADDRESS         where to listen: an address of this machine           (127.0.0.1)
  --port PORT            TCP port                                              (4840)
  --folder FOLDER        own certificate, and those of clients                 (./pose_wall_opcua)
  --user NAME            let in this user instead of anybody
  --password-file FILE   its password: the first line of FILE
  --stale-ms MS          a result counts for so long, 300 to 1000               (1000)
  --allow-none           beyond loopback, too, let in clients that neither sign nor encrypt
  --help, --version      this text; the version

Beyond loopback only signed and encrypted connections are answered (Basic256Sha256 and better). A client that comes for
the first time is refused, and its certificate lies in FOLDER/rejected. Look at it, and move it to FOLDER/trusted/certs.

Exit status: 0 stopped by SIGTERM or SIGINT, 1 cannot listen, 2 wrong options.`;

const OPTIONS = { daemon: { type: 'string', default: 'http://127.0.0.1:8080' }, host: { type: 'string', default: '127.0.0.1' },
  'daemon-ca': { type: 'string' }, 'daemon-login': { type: 'string' }, port: { type: 'string', default: '4840' }, folder: { type: 'string', default: './pose_wall_opcua' },
  user: { type: 'string' }, 'password-file': { type: 'string' }, 'stale-ms': { type: 'string', default: '1000' },
  'allow-none': { type: 'boolean', default: false }, help: { type: 'boolean' }, version: { type: 'boolean' } };
const STOP_STALE_MS = 500;  // "No message for half a second is a stop": tools/apps/live/README.md
const EVERY_MS = 100;       // results come at 10 to 20 Hz, and in silence ten times a second
const HEALTH_EVERY_MS = 1000, HEALTH_STALE_MS = 3000;
const SESSIONS_MOST = 20;   // a plant has a few clients; each takes memory

const log = (words) => console.error(`pose_wall_opcua: ${words}`);
const fail = (status, words) => { log(words); process.exit(status); };
const isLoopback = (host) => ['::1', '[::1]', 'localhost'].includes(host) || /^127\./.test(host);

function content(given, option) {
  try { return readFileSync(given[option], 'utf8'); } catch (error) { return fail(2, `--${option}: ${error.message}`); }
}

function firstLine(given, option) {
  const [line] = content(given, option).split('\n');
  if (!line) fail(2, `--${option}: ${given[option]} begins with an empty line`);
  return line;
}

function options() {
  let given;
  try { given = parseArgs({ options: OPTIONS }).values; } catch (error) { fail(2, `${error.message}; see --help`); }
  if (given.help) { console.log(HELP); process.exit(0); }
  const about = JSON.parse(readFileSync(new URL('./package.json', import.meta.url), 'utf8'));
  if (given.version) { console.log(about.version); process.exit(0); }
  const port = Number(given.port), staleMs = Number(given['stale-ms']), daemon = URL.canParse?.(given.daemon) ?? true;
  if (!(Number.isInteger(port) && port > 0 && port < 65536)) fail(2, `--port: ${given.port} is no port`);
  if (!isIP(given.host)) fail(2, `--host: ${given.host} is no address of IP`);
  if (!(staleMs >= 300 && staleMs <= 1000)) fail(2, `--stale-ms: ${given['stale-ms']} is not within 300 to 1000`);
  if (!daemon || !/^https?:\/\//.test(given.daemon)) fail(2, `--daemon: ${given.daemon} is no address of HTTP`);
  if (given['daemon-ca'] && !given.daemon.startsWith('https://')) fail(2, '--daemon-ca: --daemon has no https');
  if (!given.user !== !given['password-file']) fail(2, '--user and --password-file go together');
  if (given['daemon-login'] && given.daemon.startsWith('http://') && !isLoopback(new URL(given.daemon).hostname)) {
    fail(2, '--daemon-login: beyond loopback it would be read on the way; use https');
  }
  const login = given['daemon-login'] && firstLine(given, 'daemon-login');
  if (login && !/^[^:]+:./.test(login)) fail(2, `--daemon-login: ${given['daemon-login']} has no NAME:PASSWORD`);
  return { ...given, port, staleMs, login, ca: given['daemon-ca'] && content(given, 'daemon-ca'),
    password: given.user && firstLine(given, 'password-file'), version: about.version };
}

function documents({ daemon, staleMs, ca, login }) {
  const document = (path, more) => new Document({ url: new URL(path, daemon), log, ca, login, ...more });
  return {
    state: document('/state.json', { everyMs: EVERY_MS, staleMs, isSound: stateIsSound, counter: (x) => x.publication }),
    planar: document('/planar.json', { everyMs: EVERY_MS, staleMs: Math.min(staleMs, STOP_STALE_MS),
      isSound: stopIsSound, counter: (x) => x.stop.heartbeat }),
    // It is a whole answer with 503 as well: then a part has failed.
    health: document('/health', { everyMs: HEALTH_EVERY_MS, staleMs: HEALTH_STALE_MS, isSound: healthIsSound,
      counter: () => performance.now(), answers: [200, 503] }),
  };
}

async function serverOf(given) {
  // The library takes two seconds to load: options are looked at before.
  const { OPCUAServer } = await import('node-opcua-server');
  const { OPCUACertificateManager } = await import('node-opcua-certificate-manager');
  const { MessageSecurityMode, SecurityPolicy } = await import('node-opcua-secure-channel');
  const isOpen = given['allow-none'] || isLoopback(given.host);
  const manager = (folder) => new OPCUACertificateManager({ rootFolder: folder, automaticallyAcceptUnknownCertificate: false });
  const certificates = manager(resolve(given.folder)), userCertificates = manager(resolve(given.folder, 'users'));
  await certificates.initialize();
  await userCertificates.initialize();
  return new OPCUAServer({
    host: given.host, hostname: given.host, port: given.port, maxConnectionsPerEndpoint: SESSIONS_MOST,
    serverCertificateManager: certificates, userCertificateManager: userCertificates,
    certificateFile: join(resolve(given.folder), 'own/certs/pose_wall_opcua.pem'),
    securityModes: [...(isOpen ? [MessageSecurityMode.None] : []), MessageSecurityMode.SignAndEncrypt],
    securityPolicies: [...(isOpen ? [SecurityPolicy.None] : []), SecurityPolicy.Basic256Sha256,
      SecurityPolicy.Aes128_Sha256_RsaOaep, SecurityPolicy.Aes256_Sha256_RsaPss],
    allowAnonymous: !given.user,
    userManager: { isValidUser: (name, word) => Boolean(given.user) && name === given.user && word === given.password },
    serverCapabilities: { maxSessions: SESSIONS_MOST },
    serverInfo: { applicationUri: `urn:${hostname()}:pose_wall_opcua`, productUri: 'urn:pose_wall:opcua',
      applicationName: { text: 'pose_wall' } },
    buildInfo: { productName: 'pose_wall_opcua', softwareVersion: given.version, buildNumber: given.version,
      manufacturerName: 'the pose_wall authors' } });
}

globalThis.crypto ??= webcrypto;  // Node.js 18 has it under this name alone; the library wants the global one
const given = options();
const { addModel, rows } = await import('./model.mjs');
const server = await serverOf(given).catch((error) => fail(1, error.message));
const read = documents(given);
await server.initialize();
addModel(server, read, EVERY_MS);
await server.start().catch((error) => fail(1, error.message));
Object.values(read).forEach((document) => document.begin());
log(`${rows().length} variables at opc.tcp://${given.host}:${given.port}, of pose_walld at ${given.daemon}`);
for (const signal of ['SIGTERM', 'SIGINT']) {
  process.once(signal, async () => {
    Object.values(read).forEach((document) => document.close());
    await server.shutdown(0);
    process.exit(0);
  });
}
