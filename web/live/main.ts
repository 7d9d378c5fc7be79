// Starts the live page: with the native engine or a stream if the server of `corpuscle stream --serve` has sent the page, else with the engine in the
// page.

import {bytesOf} from "../base/arrays";
import {h} from "../base/dom";
import {SocketEngine, WorkerEngine, notStarted} from "./engine";
import {showLivePage} from "./page";
import {showStreamPage} from "./stream-page";

declare const DecompressionStream: new (format: string) => GenericTransformStream & ReadableWritablePair;  // TypeScript 4.8 does not know it

/// `worker`: the script of the engine's worker; `catalogue`: the engine's answer to the request `catalogue`. The page has the engine, compressed by
/// gzip, as base64.
export async function startLivePage(worker: string, catalogue: object) {
    const served = (name: string) => document.querySelector<HTMLMetaElement>(`meta[name=${name}]`);  // added by the server
    const socket = (path: string) => `${location.protocol.replace("http", "ws")}//${location.host}/${path}${location.search}`;
    if (served("corpuscle-stream")) return showStreamPage(socket("stream"));
    const engine = served("corpuscle-engine");
    if (engine) return showLivePage(new SocketEngine(socket("engine"), Number(engine.content)));
    try {
        const module = await unpackedEngine();
        return showLivePage(new WorkerEngine(worker, module), catalogue);
    } catch (error) {  // an older browser, or a damaged file
        document.body.append(h("p", {class: "note", role: "alert"}, notStarted((error as Error).message)));
    }
}

function unpackedEngine(): Promise<ArrayBuffer> {
    const bytes = bytesOf(document.getElementById("engine")!.textContent!);
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
