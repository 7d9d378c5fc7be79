// Starts the live page: with the native engine if a server of `corpuscle stream --serve` has sent the page, else with the engine in the page.

import {SocketEngine, WorkerEngine} from "./engine";
import {showLivePage} from "./page";

/// `worker`: the script of the engine's worker; `wasm`: its module as base64.
export function startLivePage(worker: string, wasm: string) {
    const isServed = document.querySelector("meta[name=corpuscle-engine]") !== null;
    if (isServed) return showLivePage(new SocketEngine(`${location.protocol.replace("http", "ws")}//${location.host}/engine${location.search}`));
    const text = atob(wasm), bytes = new Uint8Array(text.length);
    for (let k = 0; k < bytes.length; ++k) bytes[k] = text.charCodeAt(k);
    return showLivePage(new WorkerEngine(worker, bytes.buffer));
}
