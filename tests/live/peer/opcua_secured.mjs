// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A client that signs and encrypts, of the gateway's own maker: node opcua_secured.mjs PORT FOLDER [USER PASSWORD]
// Prints one line of JSON: the status of PoseWall.Yaw.Value, or the error.
import { webcrypto } from 'node:crypto';
import { createRequire } from 'node:module';

globalThis.crypto ??= webcrypto;  // Node.js 18
const require = createRequire(import.meta.url);
const of = createRequire(require.resolve('node-opcua-server'));  // the server's own dependencies
const { OPCUAClient, UserTokenType } = of('node-opcua-client');
const { OPCUACertificateManager } = require('node-opcua-certificate-manager');
const { MessageSecurityMode, SecurityPolicy } = require('node-opcua-secure-channel');

const [port, folder, userName, password] = process.argv.slice(2);
const certificates = new OPCUACertificateManager({ rootFolder: folder, automaticallyAcceptUnknownCertificate: true });
await certificates.initialize();
const client = OPCUAClient.create({ applicationName: 'peer', clientCertificateManager: certificates, endpointMustExist: false,
  securityMode: MessageSecurityMode.SignAndEncrypt, securityPolicy: SecurityPolicy.Basic256Sha256,
  connectionStrategy: { maxRetry: 0, initialDelay: 100, maxDelay: 100 } });
try {
  await client.connect(`opc.tcp://127.0.0.1:${port}`);
  const session = await client.createSession(userName ? { type: UserTokenType?.UserName ?? 1, userName, password } : undefined);
  const names = (await session.readNamespaceArray());
  const { statusCode } = await session.read({ nodeId: `ns=${names.indexOf('urn:pose_wall')};s=PoseWall.Yaw.Value`, attributeId: 13 });
  console.log(JSON.stringify({ status: statusCode.value }));
} catch (error) {
  console.log(JSON.stringify({ error: error.message }));
}
process.exit(0);
