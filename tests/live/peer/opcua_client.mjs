// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A client of OPC UA by another maker than the gateway's: every structure is written and read by HBK's `opcua`, which
// generated them from the OPC Foundation's schemas. It was made for a WebSocket; here the same messages go by TCP.
// node opcua_client.mjs PORT: takes lines of JSON {"do": "read" | "browse" | "write" | "subscribe", ...} and answers each
// by one. What a subscription brings comes as {"data": node, ...}. Text nodes are of the namespace urn:pose_wall.
import { createRequire } from 'node:module';
import net from 'node:net';
import readline from 'node:readline';

const from = (name) => createRequire(import.meta.url)(`opcua/dist/${name}`);
const ua = from('ua/generated.js'), { mapNameToId, mapIdToName } = from('id/id.js');
const { Message, ChunkHeader } = from('uasc/Message.js');
const { NewFourByteNodeId, NewStringNodeId } = from('ua/NodeId.js');
const [ExpandedNodeId, Variant, DataValue, ExtensionObject, LocalizedText, Bucket, Header, Symmetric, Sequence, Hello,
  Acknowledge, Connection] = ['ua/ExpandedNodeId', 'ua/Variant', 'ua/DataValue', 'ua/ExtensionObject', 'ua/LocalizedText',
  'ua/Bucket', 'uasc/SecureConversationMessageHeader', 'uasc/SymmetricSecurityHeader', 'uasc/SequenceHeader',
  'uacp/HelloMessage', 'uacp/AcknowledgeMessage', 'uacp/ConnectionProtocolMessageHeader'].map((n) => from(`${n}.js`).default);
const VALUE = 13, WORDS = { 1: 'Boolean', 6: 'Int32', 7: 'UInt32', 8: 'Int64', 9: 'UInt64', 11: 'Double', 12: 'String', 17: 'NodeId',
  20: 'QualifiedName', 21: 'LocalizedText', 22: 'ExtensionObject', 3: 'Byte' };

// It reads no arrays yet ("todo"): the elements follow their number.
const decodeOne = Variant.prototype.decode;
Variant.prototype.decode = function decode(bytes, position) {
  let end = decodeOne.call(this, bytes, position);
  if (this.has(0x80)) {
    const bucket = new Bucket(bytes, end);
    this.Value = Array.from({ length: this.ArrayLength }, () => this.decodeValue(bucket));
    end = bucket.position;
  }
  return end;
};

// Nor has it the body of a notification, which is a subtype in the schema; its elements it has.
ua.DataChangeNotification = class DataChangeNotification {
  decode(bytes, position) {
    const bucket = new Bucket(bytes, position), elements = (Type) => Array.from({ length: Math.max(bucket.readInt32(), 0) }, () => {
      const element = new Type();
      bucket.readStruct(element);
      return element;
    });
    this.MonitoredItems = elements(ua.MonitoredItemNotification);
    elements(from('ua/DiagnosticInfo.js').default);
    return bucket.position;
  }
};

class Session {
  constructor(port) {
    Object.assign(this, { channel: 0, token: 0, sequence: 0, waiting: new Map(), buffer: Buffer.alloc(0), parts: [] });
    this.socket = net.connect(port, '127.0.0.1');
    this.socket.on('data', (data) => this.take(data));
    this.socket.on('close', () => { this.lost?.(new Error('the connection is lost')); for (const [, w] of this.waiting) w.reject(new Error('the connection is lost')); });
    this.socket.on('error', (error) => this.lost?.(error));
  }

  take(data) {
    this.buffer = Buffer.concat([this.buffer, data]);
    while (this.buffer.length >= 8 && this.buffer.length >= this.buffer.readUInt32LE(4)) {
      const message = this.buffer.subarray(0, this.buffer.readUInt32LE(4));
      this.buffer = this.buffer.subarray(message.length);
      this.message(new Uint8Array(message).buffer);
    }
  }

  message(bytes) {
    const kind = Buffer.from(bytes, 0, 3).toString();
    if (kind === 'ACK') { new Acknowledge().decode(bytes, 8); this.acknowledged(); return; }
    if (kind === 'ERR') { this.lost(new Error(`refused: 0x${new DataView(bytes).getUint32(8, true).toString(16)}`)); return; }
    const header = new ChunkHeader(), begin = header.decode(bytes);
    this.parts.push(Buffer.from(bytes, begin));
    if (header.Header.IsFinal !== 'F') return;  // more of it follows
    const whole = new Uint8Array(Buffer.concat(this.parts)).buffer, bucket = new Bucket(whole, 0), type = new ExpandedNodeId();
    this.parts = [];
    bucket.readStruct(type);
    const answer = new ua[mapIdToName.get(type.NodeId.Identifier)]();
    bucket.readStruct(answer);
    if (answer instanceof ua.OpenSecureChannelResponse) {
      this.channel = answer.SecurityToken.ChannelId;
      this.token = answer.SecurityToken.TokenId;
    }
    const waiting = this.waiting.get(header.SequenceHeader.RequestId), result = answer.ResponseHeader.ServiceResult;
    this.waiting.delete(header.SequenceHeader.RequestId);
    if (result >>> 30 === 2) waiting?.reject(new Error(`service refused: 0x${result.toString(16)}`));
    else waiting?.resolve(answer);
  }

  ask(request) {
    const name = request.constructor.name, number = this.sequence += 1, opens = name === 'OpenSecureChannelRequest';
    request.RequestHeader.AuthenticationToken = this.authentication ?? request.RequestHeader.AuthenticationToken;
    request.RequestHeader.RequestHandle = number;
    const chunk = new ChunkHeader({ Header: new Header({ MessageType: opens ? 'OPN' : 'MSG', IsFinal: 'F', SecureChannelId: this.channel }),
      SequenceHeader: new Sequence({ SequenceNumber: number, RequestId: number }) });
    if (!opens) chunk.SecurityHeader = new Symmetric({ TokenId: this.token });
    const message = new Message({ ChunkHeader: chunk, Service: request,
      TypeId: new ExpandedNodeId({ NodeId: NewFourByteNodeId(0, mapNameToId.get(name)) }) });
    return new Promise((resolve, reject) => {
      this.waiting.set(number, { resolve, reject });
      this.lost = reject;
      this.socket.write(Buffer.from(message.encode()));
    });
  }

  async open(port) {
    const hello = Buffer.from(new Hello({ ReceiveBufferSize: 65535, SendBufferSize: 65535, EndpointUrl: `opc.tcp://127.0.0.1:${port}` }).encode());
    const head = Buffer.from(new Connection({ MessageType: 'HEL', ChunkType: 'F', MessageSize: hello.length + 8 }).encode());
    await new Promise((resolve, reject) => { this.acknowledged = resolve; this.lost = reject; this.socket.write(Buffer.concat([head, hello])); });
    await this.ask(new ua.OpenSecureChannelRequest({ SecurityMode: ua.MessageSecurityModeNone, RequestedLifetime: 3600000 }));
    const created = await this.ask(new ua.CreateSessionRequest({ EndpointUrl: `opc.tcp://127.0.0.1:${port}`, SessionName: 'peer',
      RequestedSessionTimeout: 60000, ClientNonce: new Uint8Array(32) }));
    const mine = created.ServerEndpoints.find((e) => e.SecurityMode === ua.MessageSecurityModeNone);
    const anonymous = mine?.UserIdentityTokens.find((t) => t.TokenType === ua.UserTokenTypeAnonymous);
    this.endpoints = created.ServerEndpoints.map((e) => ({ mode: e.SecurityMode, policy: e.SecurityPolicyUri.split('#')[1], url: e.EndpointUrl }));
    this.authentication = created.AuthenticationToken;
    await this.ask(new ua.ActivateSessionRequest({ UserIdentityToken: new ExtensionObject({ Encoding: 1,
      TypeId: new ExpandedNodeId({ NodeId: NewFourByteNodeId(0, mapNameToId.get('AnonymousIdentityToken')) }),
      Value: new ua.AnonymousIdentityToken({ PolicyId: anonymous?.PolicyId ?? '' }) }) }));
    const [names] = (await this.ask(new ua.ReadRequest({ NodesToRead: [new ua.ReadValueId({ NodeId: NewFourByteNodeId(0, 2255), AttributeId: VALUE })] }))).Results;
    this.namespace = names.Value.Value.indexOf('urn:pose_wall');
  }

  node(name) { return typeof name === 'number' ? NewFourByteNodeId(0, name) : NewStringNodeId(this.namespace, name); }
}

const plain = (x) => (typeof x === 'bigint' ? String(x) : x instanceof LocalizedText ? { locale: x.Locale, text: x.Text }
  : x instanceof ExtensionObject ? plain(x.Value) : Array.isArray(x) ? x.map(plain)
    : x?.Identifier !== undefined ? x.Identifier : x && typeof x === 'object' ? Object.fromEntries(Object.entries(x).map(([k, v]) => [k, plain(v)])) : x);
const told = (x) => ({ type: x.Value ? WORDS[x.Value.type()] ?? x.Value.type() : null, value: x.Value ? plain(x.Value.Value) : null,
  status: x.Status ?? 0, source_ms: x.SourceTimestamp?.getTime() ?? null, server_ms: x.ServerTimestamp?.getTime() ?? null });

const port = Number(process.argv[2]), session = new Session(port);
const names = new Map();

async function publish() {
  let done = [];
  for (;;) {
    const answer = await session.ask(new ua.PublishRequest({ SubscriptionAcknowledgements: done }));
    done = [new ua.SubscriptionAcknowledgement({ SubscriptionId: answer.SubscriptionId, SequenceNumber: answer.NotificationMessage.SequenceNumber })];
    for (const { Value } of answer.NotificationMessage.NotificationData ?? []) {
      for (const item of Value?.MonitoredItems ?? []) console.log(JSON.stringify({ data: names.get(item.ClientHandle), ...told(item.Value) }));
    }
  }
}

const deeds = {
  endpoints: async () => session.endpoints,
  read: async ({ nodes, attribute }) => (await session.ask(new ua.ReadRequest({ TimestampsToReturn: ua.TimestampsToReturnBoth,
    NodesToRead: nodes.map((name) => new ua.ReadValueId({ NodeId: session.node(name), AttributeId: attribute ?? VALUE })) }))).Results.map(told),
  browse: async ({ node }) => (await session.ask(new ua.BrowseRequest({ View: new ua.ViewDescription({}), NodesToBrowse: [new ua.BrowseDescription({
    NodeId: session.node(node), BrowseDirection: ua.BrowseDirectionForward, ReferenceTypeId: NewFourByteNodeId(0, 33), IncludeSubtypes: true,
    NodeClassMask: 0, ResultMask: 63 })] }))).Results[0].References.map((r) => ({ node: plain(r.NodeId.NodeId), name: r.BrowseName.Name,
    kind: r.NodeClass, type: plain(r.TypeDefinition.NodeId) })),
  write: async ({ node, value }) => [...(await session.ask(new ua.WriteRequest({ NodesToWrite: [new ua.WriteValue({ NodeId: session.node(node),
    AttributeId: VALUE, Value: new DataValue({ EncodingMask: 1, Value: new Variant({ EncodingMask: 11, Value: value }) }) })] }))).Results],
  subscribe: async ({ nodes, ms }) => {
    const { SubscriptionId } = await session.ask(new ua.CreateSubscriptionRequest({ RequestedPublishingInterval: ms, RequestedLifetimeCount: 1000,
      RequestedMaxKeepAliveCount: 10, PublishingEnabled: true }));
    const items = nodes.map((name) => {
      names.set(names.size + 1, name);
      return new ua.MonitoredItemCreateRequest({ ItemToMonitor: new ua.ReadValueId({ NodeId: session.node(name), AttributeId: VALUE }),
        MonitoringMode: ua.MonitoringModeReporting, RequestedParameters: new ua.MonitoringParameters({ ClientHandle: names.size,
          SamplingInterval: ms, QueueSize: 10, DiscardOldest: true }) });
    });
    const made = await session.ask(new ua.CreateMonitoredItemsRequest({ SubscriptionId, TimestampsToReturn: ua.TimestampsToReturnBoth, ItemsToCreate: items }));
    publish().catch((error) => console.log(JSON.stringify({ error: error.message })));
    return made.Results.map((r) => r.StatusCode);
  },
};

try { await session.open(port); } catch (error) { console.log(JSON.stringify({ error: error.message })); process.exit(1); }
console.log(JSON.stringify({ answer: session.endpoints }));
for await (const line of readline.createInterface({ input: process.stdin })) {
  const asked = JSON.parse(line);
  try { console.log(JSON.stringify({ answer: await deeds[asked.do](asked) })); } catch (error) { console.log(JSON.stringify({ error: error.stack })); }
}
process.exit(0);
