// Starts the live page: with the native engine or a stream if the server of `corpuscle stream --serve` has sent the page, else with the engine in the
// page.

import {SocketEngine, WorkerEngine} from "./engine";
import {showLivePage} from "./page";
import {showStreamPage} from "./stream-page";

declare const DecompressionStream: new (format: string) => GenericTransformStream & ReadableWritablePair;  // TypeScript 4.8 does not know it

/// `worker`: the script of the engine's worker; `wasm`: its module, compressed by gzip, as base64.
export async function startLivePage(worker: string, wasm: string) {
    const isPurpose = (name: string) => document.querySelector(`meta[name=${name}]`) !== null;
    const socket = (path: string) => `${location.protocol.replace("http", "ws")}//${location.host}/${path}${location.search}`;
    if (isPurpose("corpuscle-stream")) return showStreamPage(socket("stream"));
    if (isPurpose("corpuscle-engine")) return showLivePage(new SocketEngine(socket("engine")));
    const bytes = Uint8Array.from(atob(wasm), (c) => c.charCodeAt(0));
    const module = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
    return showLivePage(new WorkerEngine(worker, module));
}
