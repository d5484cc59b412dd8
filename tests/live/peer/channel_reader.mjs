// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Channels as viewers read them, live or of a recording: each message by its schema, with readers that others wrote.
import { parse } from '@foxglove/rosmsg';
import { MessageReader } from '@foxglove/rosmsg2-serialization';
import * as published from '@foxglove/schemas/jsonschema.js';
import Ajv from 'ajv/dist/2020.js'; // knows "nullable", as our schemas have it

const text = new TextDecoder();

// What Lichtblick (packages/mcap-support, parseJsonSchema.ts) and Foxglove ask of a schema: one type a member, items with
// a type. Of anything else they show nothing of the channel.
function faultForViewers(schema, path = '') {
  if (path === '' && schema.type !== 'object') return 'the root is no object';
  for (const [name, member] of Object.entries(schema.properties ?? {})) {
    const at = `${path}.${name}`;
    if (Array.isArray(member.oneOf)) {
      if (!member.oneOf.every((one) => typeof one.const === 'number')) return `${at}: alternatives without numbers`;
    } else if (member.type === 'array') {
      if (!['boolean', 'string', 'number', 'integer', 'object'].includes(member.items?.type)) return `${at}: items of no type`;
      const fault = member.items.type === 'object' && faultForViewers(member.items, at);
      if (fault) return fault;
    } else if (member.type === 'object') {
      const fault = faultForViewers(member, at);
      if (fault) return fault;
    } else if (!['boolean', 'string', 'number', 'integer'].includes(member.type)) {
      return `${at}: type ${JSON.stringify(member.type)}`;
    }
  }
  return '';
}

// A member that a message has and its schema does not name: viewers would not offer it for plots.
function unnamed(value, schema, path = '') {
  if (value === null || typeof value !== 'object') return '';
  if (Array.isArray(value)) return value.map((item) => unnamed(item, schema.items ?? {}, `${path}[]`)).find(Boolean) ?? '';
  if (!Object.keys(schema.properties ?? {}).length) return ''; // names that nobody knows before
  for (const [name, member] of Object.entries(value)) {
    if (member === null || (Array.isArray(member) && !member.length)) continue;
    if (!schema.properties[name]) return `${path}.${name}`;
    const deeper = unnamed(member, schema.properties[name], `${path}.${name}`);
    if (deeper) return deeper;
  }
  return '';
}

// What of a schema decides how messages are read.
function bones(schema) {
  if (Array.isArray(schema)) return schema.map(bones);
  if (schema === null || typeof schema !== 'object') return schema;
  const kept = {};
  for (const key of ['type', 'contentEncoding', 'const', 'minimum', 'required']) if (key in schema) kept[key] = schema[key];
  if (schema.required) kept.required = [...schema.required].sort();
  if (schema.oneOf) kept.oneOf = schema.oneOf.map((one) => ({ title: one.title, const: one.const }));
  if (schema.items) kept.items = bones(schema.items);
  if (schema.properties) {
    kept.properties = Object.fromEntries(Object.keys(schema.properties).sort().map((name) => [name, bones(schema.properties[name])]));
  }
  return kept;
}

// channel: topic, encoding, schemaName, schemaEncoding, schema (text).
export class ChannelReader {
  constructor(channel) {
    this.told = { schema: channel.schemaName, encoding: channel.encoding, messages: 0, faults: [] };
    try {
      if (channel.encoding === 'cdr' && channel.schemaEncoding === 'ros2msg') this.readRos(channel);
      else if (channel.encoding === 'json' && channel.schemaEncoding === 'jsonschema') this.readJson(channel);
      else this.fault(`nobody reads ${channel.encoding} by ${channel.schemaEncoding}`);
    } catch (fault) {
      this.fault(`schema: ${fault.message}`);
    }
  }

  fault(what) {
    if (this.told.faults.length < 5) this.told.faults.push(String(what).slice(0, 300));
  }

  readRos(channel) {
    const reader = new MessageReader(parse(channel.schema, { ros2: true }));
    this.decode = (data) => reader.readMessage(data);
  }

  readJson(channel) {
    const schema = JSON.parse(channel.schema);
    const forViewers = faultForViewers(schema);
    if (forViewers) this.fault(`viewers refuse it: ${forViewers}`);
    const validate = new Ajv({ strict: false, validateFormats: false }).compile(schema);
    const [maker, name] = channel.schemaName.split('.');
    const theirs = maker === 'foxglove' ? published[name] : undefined;
    if (maker === 'foxglove' && JSON.stringify(bones(schema)) !== JSON.stringify(bones(theirs ?? {}))) {
      this.fault('the schema is not the published one');
    }
    const published_one = theirs && new Ajv({ strict: false, validateFormats: false }).compile(theirs);
    this.decode = (data) => {
      const message = JSON.parse(text.decode(data));
      if (!validate(message)) throw new Error(`by its schema: ${JSON.stringify(validate.errors[0])}`);
      if (published_one && !published_one(message)) throw new Error(`by the published one: ${JSON.stringify(published_one.errors[0])}`);
      const more = unnamed(message, schema);
      if (more) throw new Error(`the schema does not name ${more}`);
      return message;
    };
  }

  take(data) {
    ++this.told.messages;
    try {
      const message = this.decode(data);
      this.told.newest = summary(message);
      return message;
    } catch (fault) {
      this.fault(fault.message);
      return undefined;
    }
  }
}

// Of a message what a test looks at: large fields by their length.
function summary(value) {
  if (ArrayBuffer.isView(value)) return { length: value.length };
  if (typeof value === 'bigint') return Number(value);
  if (Array.isArray(value)) return value.slice(0, 16).map(summary);
  if (value === null || typeof value !== 'object') return Number.isNaN(value) ? null : value;
  return Object.fromEntries(Object.entries(value).map(([name, member]) => [name, summary(member)]));
}
