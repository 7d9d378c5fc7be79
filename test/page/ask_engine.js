// node ask_engine.js ENGINE.js: reads requests, one JSON object per line, and prints the answers in the same way. The arrays of a message are
// its key "data": lists of numbers by name. An answer also has "ready", the time in s in which the engine started, and "seconds", that of the request.
"use strict";
const readline = require("readline");
const started = process.hrtime.bigint();
const seconds = () => Number(process.hrtime.bigint() - started) * 1e-9;
const types = { f32: Float32Array, f64: Float64Array, u32: Uint32Array, u8: Uint8Array };

/// Lists of numbers become f64, texts u8.
function encode({ data = {}, ...head }) {
  const arrays = Object.entries(data).map(([name, values]) => ({ name, values: typeof values === "string" ? Buffer.from(values) : Float64Array.from(values) }));
  if (arrays.length > 0) head.arrays = arrays.map(({ name, values }) => ({ name, type: values instanceof Float64Array ? "f64" : "u8", count: values.length }));
  const padded = (bytes, size, fill) => Buffer.concat([bytes, Buffer.alloc((8 - (size % 8)) % 8, fill)]);
  const text = padded(Buffer.from(JSON.stringify(head)), 4 + Buffer.byteLength(JSON.stringify(head)), " ");
  const length = Buffer.alloc(4);
  length.writeUInt32LE(text.length);
  const bytes = ({ values }) => Buffer.from(values.buffer, values.byteOffset, values.byteLength);
  return Buffer.concat([length, text, ...arrays.map((array) => padded(bytes(array), bytes(array).length, 0))]);
}

function decode(bytes) {
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(Buffer.from(buffer, 4, length).toString());
  let at = 4 + length;
  head.data = {};
  for (const { name, type, count } of head.arrays ?? []) {
    head.data[name] = Array.from(new types[type](buffer, at, count));
    at += Math.ceil((count * types[type].BYTES_PER_ELEMENT) / 8) * 8;
  }
  return head;
}

async function main() {
  const script = require("path").resolve(process.argv[2]);
  const module = await require(script)({ wasmBinary: require("fs").readFileSync(script.replace(/\.js$/, ".wasm")) });
  const engine = module._corpuscle_page_create();
  const ready = seconds();
  for await (const line of readline.createInterface({ input: process.stdin })) {
    const before = seconds(), request = encode(JSON.parse(line));
    const at = module._malloc(request.length);
    module.HEAPU8.set(request, at);
    const begin = module._corpuscle_page_request(engine, at, request.length);
    module._free(at);
    const answer = module.HEAPU8.slice(begin, begin + module._corpuscle_page_answer_length(engine));
    const taken = seconds() - before;
    console.log(JSON.stringify({ ...decode(answer), ready, seconds: taken }));
  }
}
main();
