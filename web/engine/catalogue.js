// node catalogue.js ENGINE.js: prints the engine's answer to the request `catalogue`, which the page contains so that it opens sooner.
"use strict";
const fs = require("fs"), path = require("path");
const script = path.resolve(process.argv[2]);

require(script)({wasmBinary: fs.readFileSync(script.replace(/\.js$/, ".wasm"))}).then((module) => {
    const head = Buffer.from('{"request": "catalogue"}    '), length = Buffer.alloc(4);  // a message (doc/page-protocol.md): 32 bytes
    length.writeUInt32LE(head.length);
    const request = Buffer.concat([length, head]), at = module._malloc(request.length);
    module.HEAPU8.set(request, at);
    const begin = module._corpuscle_page_request(module._corpuscle_page_create(), at, request.length);
    const bytes = new DataView(module.HEAPU8.buffer, begin).getUint32(0, true);
    process.stdout.write(Buffer.from(module.HEAPU8.buffer, begin + 4, bytes).toString().trimEnd());
});
