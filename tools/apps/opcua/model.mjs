// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The information model, a row for each variable, and how a row becomes a node. README.md has the same table, and
// tests/live/opcua_peer.py compares the two.
import { makeAccessLevelFlag, coerceLocalizedText } from 'node-opcua-data-model';
import { DataValue } from 'node-opcua-data-value';
import { StatusCodes } from 'node-opcua-status-code';
import { EUInformation } from 'node-opcua-types';
import { DataType, Variant, VariantArrayType } from 'node-opcua-variant';

import { GRADES, QUANTITIES, STATES, STOP_STATES, unitOf } from './daemon.mjs';

export const NAMESPACE = 'urn:pose_wall';

// Common codes of UNECE Recommendation 20, as OPC 10000-8 5.6.3 takes them into EUInformation.
const UNITS = { rad: ['C81', 'radian'], m: ['MTR', 'metre'], 'm/s': ['MTS', 'metre per second'], s: ['SEC', 'second'] };
const CEFACT = 'http://www.opcfoundation.org/UA/units/un/cefact';
const NAMES = { roll: 'Roll', pitch: 'Pitch', yaw: 'Yaw', d_lf: 'LeftFront', d_lb: 'LeftBack', d_rf: 'RightFront',
  d_rb: 'RightBack' };

// The status of a value by its state (README.md says why): only what may steer is Good.
function statusOfValue(state, quantity) {
  const value = state.values[quantity];
  if (state.steer[QUANTITIES.indexOf(quantity)].may_steer) return StatusCodes.Good;
  if (value.state === 'invalid') return state.told_by === 'silence' ? StatusCodes.BadSensorFailure : StatusCodes.Bad;
  return value.state === 'held' ? StatusCodes.UncertainLastUsableValue : StatusCodes.UncertainSensorNotAccurate;
}

const uint64 = (x) => [Math.floor(x / 2 ** 32), x % 2 ** 32];
const int64 = (text) => { const x = BigInt.asUintN(64, BigInt(text)); return [Number(x >> 32n), Number(x & 0xffffffffn)]; };
const text = (locale) => (words) => coerceLocalizedText({ locale, text: words });
const worst = (health) => health.parts.reduce((a, b) => (GRADES.indexOf(b.grade) > GRADES.indexOf(a.grade) ? b : a));

/** Rows: folder and name, document, kind (a unit, words of an enumeration, or a data type), value, status. */
export function rows() {
  const all = [];
  const add = (name, from, kind, read, description, status = () => StatusCodes.Good) =>
    all.push({ name, from, kind, read, description, status });
  add('SteerEn', 'state', 'LocalizedText', (x) => text('en')(x.steer_line.en), 'what may steer, what not, and why');
  add('SteerZh', 'state', 'LocalizedText', (x) => text('zh-CN')(x.steer_line.zh), 'the same in Chinese');
  add('Status', 'state', STATES, (x) => STATES.indexOf(x.status), 'the worst of the seven states');
  add('ToldBy', 'state', 'String', (x) => x.told_by, 'frame; silence: the sensor is silent');
  add('Frame', 'state', 'UInt64', (x) => uint64(x.frame), 'number of the frame');
  add('Publication', 'state', 'UInt64', (x) => uint64(x.publication), 'counts results; moves on, or the daemon stands');
  add('StampNs', 'state', 'Int64', (x) => int64(x.header_stamp_ns), "stamp of the cloud's header, ns");
  add('ConfigCrc32', 'state', 'UInt32', (x) => x.config_crc32, "CRC of the engine's settings");
  add('SourceId', 'state', 'UInt32', (x) => x.source_id, 'of the settings');
  add('Schema', 'state', 'UInt32', (x) => x.schema, 'of /state.json');
  for (const quantity of QUANTITIES) {
    const folder = NAMES[quantity], unit = unitOf(quantity), of = (x) => x.values[quantity];
    const status = (x) => statusOfValue(x, quantity);
    add(`${folder}.Value`, 'state', unit, (x) => of(x)[`value_${unit}`], 'the value', status);
    add(`${folder}.ProtectionLevel`, 'state', unit, (x) => of(x)[`protection_level_${unit}`], 'bounds its error', status);
    add(`${folder}.Sigma`, 'state', unit, (x) => of(x)[`sigma_${unit}`], 'standard deviation', status);
    add(`${folder}.State`, 'state', STATES, (x) => STATES.indexOf(of(x).state), 'its state');
    add(`${folder}.MaySteer`, 'state', 'Boolean', (x) => x.steer[QUANTITIES.indexOf(quantity)].may_steer, 'may it steer?');
    add(`${folder}.Reasons`, 'state', 'String', (x) => of(x).reasons.join(', '), 'why it is not better');
    add(`${folder}.Cause`, 'state', 'String', (x) => of(x).cause ?? '', 'largest part of its level');
    add(`${folder}.Age`, 'state', 's', (x) => of(x).age_s, 'since it was measured',
      (x) => (of(x).age_s === null ? StatusCodes.Bad : StatusCodes.Good));
  }
  const stop = (x) => x.stop;
  add('Stop.State', 'planar', STOP_STATES, (x) => STOP_STATES.indexOf(stop(x).state), 'what the obstacle stop permits');
  add('Stop.AllowedSpeed', 'planar', 'm/s', (x) => stop(x).allowed_speed_m_s, 'at most');
  add('Stop.Heartbeat', 'planar', 'UInt64', (x) => uint64(stop(x).heartbeat), 'counts answers');
  add('Stop.Reasons', 'planar', 'String', (x) => stop(x).reasons.join(', '), 'why not go');
  add('Stop.WhyEn', 'planar', 'LocalizedText', (x) => text('en')(stop(x).why.en), 'the first cause, and what would clear it');
  add('Stop.WhyZh', 'planar', 'LocalizedText', (x) => text('zh-CN')(stop(x).why.zh), 'the same in Chinese');
  add('Health.Grade', 'health', GRADES, (x) => GRADES.indexOf(worst(x).grade), 'the worst of all parts');
  add('Health.Summary', 'health', 'String', (x) => `${worst(x).part}: ${worst(x).summary}`, 'the first part of that grade');
  return all;
}

const unitCode = (letters) => [...letters].reduce((code, letter) => code << 8 | letter.charCodeAt(0), 0);

export function units(symbol) {
  const [code, description] = UNITS[symbol];
  return new EUInformation({ namespaceUri: CEFACT, unitId: unitCode(code), displayName: { text: symbol },
    description: { text: description } });
}

// The cloud's stamp; where there is none (or none that a time of OPC UA can hold), when the document came. Of what does
// not come it is the last question, as OPC 10000-4 7.11.3 has it: "the time the Server last tried to recover".
function times(document) {
  const serverTimestamp = new Date();
  if (document.status()) return { serverTimestamp, sourceTimestamp: document.askedAt };
  const ns = BigInt(document.value.header_stamp_ns ?? -1), ms = Number(ns / 1000000n);
  if (ns < 0n || ms > Date.UTC(9999, 11, 31)) return { serverTimestamp, sourceTimestamp: document.receivedAt };
  return { serverTimestamp, sourceTimestamp: new Date(ms), sourcePicoseconds: Number(ns % 1000000n) * 1000 };
}

/** What a client reads of a row now. Bad comes without a value, as OPC 10000-4 7.11 demands. */
export function dataValue(row, document) {
  const missing = document.status();
  if (missing) return new DataValue({ statusCode: StatusCodes[missing], ...times(document) });
  const statusCode = row.status(document.value);
  if (statusCode.isBad()) return new DataValue({ statusCode, ...times(document) });
  const value = new Variant({ dataType: DataType[typeOf(row)], arrayType: VariantArrayType.Scalar,
    value: row.read(document.value) });
  return new DataValue({ statusCode, value, ...times(document) });
}

const isWords = (row) => Array.isArray(row.kind);
const isAnalog = (row) => row.kind in UNITS;
const typeOf = (row) => (isWords(row) ? 'UInt32' : isAnalog(row) ? 'Double' : row.kind);

function addProperty(namespace, variable, browseName, dataType, value) {
  namespace.addVariable({ propertyOf: variable, browseName: { name: browseName, namespaceIndex: 0 }, dataType, value,
    typeDefinition: 'PropertyType', valueRank: value.arrayType === VariantArrayType.Array ? 1 : -1,
    nodeId: `s=${variable.nodeId.value}.${browseName}`, accessLevel: makeAccessLevelFlag('CurrentRead'),
    userAccessLevel: makeAccessLevelFlag('CurrentRead') });
}

/** Puts all rows under Objects/PoseWall. `documents` are state, planar and health. */
export function addModel(server, documents, everyMs) {
  const addressSpace = server.engine.addressSpace, namespace = addressSpace.registerNamespace(NAMESPACE);
  const folders = { PoseWall: namespace.addObject({ organizedBy: addressSpace.rootFolder.objects, browseName: 'PoseWall',
    nodeId: 's=PoseWall', typeDefinition: 'FolderType' }) };
  for (const row of rows()) {
    const words = `PoseWall.${row.name}`.split('.'), name = words.pop(), path = words.join('.');
    folders[path] ??= namespace.addObject({ componentOf: folders.PoseWall, browseName: words.at(-1), nodeId: `s=${path}` });
    const typeDefinition = isWords(row) ? 'MultiStateDiscreteType' : isAnalog(row) ? 'AnalogUnitType' : 'BaseDataVariableType';
    const variable = namespace.addVariable({ componentOf: folders[path], browseName: name, nodeId: `s=${path}.${name}`,
      description: row.description, dataType: typeOf(row), typeDefinition, minimumSamplingInterval: everyMs,
      accessLevel: makeAccessLevelFlag('CurrentRead'), userAccessLevel: makeAccessLevelFlag('CurrentRead'),
      // Asked at each reading and sampling, so what has grown old is never told because a timer was late.
      value: { timestamped_get: () => dataValue(row, documents[row.from]) } });
    if (isAnalog(row)) {
      addProperty(namespace, variable, 'EngineeringUnits', 'EUInformation',
        new Variant({ dataType: DataType.ExtensionObject, value: units(row.kind) }));
    } else if (isWords(row)) {
      addProperty(namespace, variable, 'EnumStrings', 'LocalizedText', new Variant({ dataType: DataType.LocalizedText,
        arrayType: VariantArrayType.Array, value: row.kind.map((word) => coerceLocalizedText({ text: word })) }));
    }
  }
}
