// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What pose_walld says at its addresses of HTTP, asked for again and again. A document counts for a limited time, and
// only if all of it is as tools/apps/live/README.md has it; until then, and after, there is a status code instead.
import http from 'node:http';
import https from 'node:https';

export const QUANTITIES = ['roll', 'pitch', 'yaw', 'd_lf', 'd_lb', 'd_rf', 'd_rb'];
export const STATES = ['invalid', 'held', 'degraded', 'valid'];  // in the order of pose_wall.h and State.msg
export const STOP_STATES = ['stop', 'slow', 'go'];               // as in Stop.msg
export const GRADES = ['ok', 'warning', 'error', 'stale'];
export const SCHEMA = 1;  // of /state.json; another one may mean other things by the same names

const TIMEOUT_MS = 400;        // of one question; shorter than any silence that is still told Good
const BYTES_MOST = 1 << 20;    // /state.json has 6 kB, /health some 10 kB

export const unitOf = (quantity) => (quantity.startsWith('d_') ? 'm' : 'rad');

const isText = (x) => typeof x === 'string';
const isCount = (x) => Number.isSafeInteger(x) && x >= 0;
// Of 64 bits, as text: JavaScript's numbers do not hold it.
const isStamp = (x) => isText(x) && /^-?\d{1,19}$/.test(x);
const isTexts = (x) => Array.isArray(x) && x.every(isText);
const isPair = (x) => isText(x?.en) && isText(x?.zh);
const isLevel = (x) => Number.isFinite(x) && x >= 0;
const orNull = (is, x) => x === null || is(x);

function valueIsSound(value, steer, quantity) {
  const unit = unitOf(quantity), number = value?.[`value_${unit}`], level = value?.[`protection_level_${unit}`];
  const sigma = value?.[`sigma_${unit}`];
  if (steer?.value !== quantity || typeof steer.may_steer !== 'boolean' || !STATES.includes(value?.state)) return false;
  if (!isTexts(value.reasons) || !orNull(isText, value.cause) || !orNull(isLevel, value.age_s)) return false;
  if (!orNull(Number.isFinite, number) || !orNull(isLevel, level) || !orNull(isLevel, sigma)) return false;
  if (value.state === 'invalid') return !steer.may_steer;
  // What may steer is valid, and has a level within the limit.
  return number !== null && level !== null && sigma !== null
      && (!steer.may_steer || (value.state === 'valid' && level <= steer[`limit_${unit}`]));
}

export function stateIsSound(x) {
  return x?.schema === SCHEMA && ['frame', 'silence'].includes(x.told_by) && isPair(x.steer_line)
      && ['frame', 'publication', 'config_crc32', 'source_id'].every((name) => isCount(x[name]))
      && isStamp(x.header_stamp_ns) && STATES.includes(x.status) && Array.isArray(x.steer)
      && x.steer.length === QUANTITIES.length
      && QUANTITIES.every((name, i) => valueIsSound(x.values?.[name], x.steer[i], name));
}

export function stopIsSound(x) {
  const stop = x?.stop;
  return STOP_STATES.includes(stop?.state) && isTexts(stop.reasons) && isCount(stop.heartbeat) && isPair(stop.why)
      && isLevel(stop.allowed_speed_m_s) && orNull(isLevel, stop.age_ms);
}

export function healthIsSound(x) {
  return Array.isArray(x?.parts) && x.parts.length > 0
      && x.parts.every((part) => isText(part?.part) && GRADES.includes(part.grade) && isText(part.summary));
}

// Stamps have more digits than a number of JavaScript: they stay text.
const parsed = (text) => JSON.parse(text.replace(/"(header_stamp_ns|stamp_ns)":\s*(-?\d+)/g, '"$1":"$2"'));

/**
 * One address: `value` is its newest document, `fault` the name of a status code instead of it. `ca`: the certificate of a
 * page with HTTPS; `login`: NAME:PASSWORD of one that asks for it.
 */
export class Document {
  constructor({ url, everyMs, staleMs, isSound, counter, answers = [200], log, ca, login }) {
    Object.assign(this, { url, everyMs, staleMs, isSound, counter, answers, log });
    this.http = url.protocol === 'https:' ? https : http;
    this.agent = new this.http.Agent({ keepAlive: true, maxSockets: 1, ca });
    this.headers = login ? { authorization: `Basic ${Buffer.from(login).toString('base64')}` } : {};
    this.value = null;
    this.fault = 'BadNoCommunication';
    this.newAt = -Infinity;
    this.receivedAt = this.askedAt = new Date();
    this.said = '';
    this.isAsking = false;
  }

  begin() {
    this.timer = setInterval(() => this.ask(), this.everyMs);
    this.ask();
  }

  /** The name of a status code that is not Good, or null while the document counts. */
  status() {
    if (this.fault) return this.fault;
    return performance.now() - this.newAt > this.staleMs ? 'BadNoCommunication' : null;
  }

  ask() {
    if (this.isAsking) return;
    this.isAsking = true;
    this.askedAt = new Date();
    // An answer is as old as its question at most: a gateway that was stopped meanwhile reads what was true before.
    const askedMs = performance.now();
    let text = '', bytes = 0;
    const done = (act) => { if (this.isAsking) { this.isAsking = false; clearTimeout(late); act(); } };
    const request = this.http.get(this.url, { agent: this.agent, headers: this.headers }, (answer) => {
      answer.setEncoding('utf8');
      answer.on('data', (part) => {
        text += part;
        if ((bytes += part.length) > BYTES_MOST) request.destroy(new Error('answers without an end'));
      });
      answer.on('error', (error) => done(() => this.lose(error.message)));
      answer.on('end', () => done(() => this.take(answer.statusCode, text, askedMs)));
    });
    // Of the whole answer: one that comes byte by byte is late, too.
    const late = setTimeout(() => request.destroy(new Error('does not answer')), TIMEOUT_MS);
    request.on('error', (error) => done(() => this.lose(error.message)));
  }

  take(code, text, askedMs) {
    if (!this.answers.includes(code)) {
      // It answers, and says that it has none of it: the key `planar` is off, or no result counts. Or it wants a login.
      this.fault = { 401: 'BadUserAccessDenied', 404: 'BadNotConnected' }[code] ?? 'BadOutOfService';
      return this.tell(`answers ${code}`);
    }
    let value;
    try { value = parsed(text); } catch { value = null; }
    if (!this.isSound(value)) {
      this.fault = 'BadCommunicationError';
      return this.tell('answers what is not understood');
    }
    // A daemon that repeats itself has stopped: only what has moved on is new.
    if (this.value === null || this.counter(value) !== this.counter(this.value)) {
      this.newAt = askedMs;
      this.receivedAt = new Date();
    }
    this.value = value;
    this.fault = null;
    return this.tell('answers');
  }

  // What it said of itself before is no news of now. Its value ages.
  lose(what) {
    if (this.fault) this.fault = 'BadNoCommunication';
    this.tell(what);
  }

  tell(what) {
    if (what !== this.said) this.log(`${this.url.pathname}: ${what}`);
    this.said = what;
  }

  close() {
    clearInterval(this.timer);
    this.agent.destroy();
  }
}
