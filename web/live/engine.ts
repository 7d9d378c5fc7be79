// The engine of the live page: WebAssembly in a worker, or native behind a WebSocket. Both answer requests in order (doc/page-protocol.md).

import {Message, NumberArray, bytesOfMessage, messageOf} from "../base/arrays";

export interface Answer { head: any; arrays: Record<string, NumberArray> }

export interface Engine {
    /// Where it computes, for the reader: "this browser".
    readonly place: string;
    /// The formats of recordings that it reads, for the reader.
    readonly formats: string;
    /// The length of the longest request.
    readonly maxMegabytes: number;
    /// Throws the sentence of an error if a file of so many bytes is too long for it. `options`: of the command that reads it.
    checkFile(bytes: number, name: string, options: string): void;
    /// Sets a function that is called with a sentence when the engine ends, after which no request is answered.
    whenEnded(act: (reason: string) => void): void;
    /// Sends a request. The promise is rejected with the sentence of the engine's error.
    request(head: object, arrays?: Record<string, NumberArray>): Promise<Answer>;
}

interface Waiting { resolve: (answer: Answer) => void; reject: (error: Error) => void }

/// The sentences for an engine in the page that does not start; `reason`: the browser's.
export const notStarted = (reason: string) => `The engine did not start (${reason}). It needs Chrome 112, Firefox 113, Safari 16.4 or later; if this is one, load the page again.`;

const megabytes = (bytes: number) => Math.ceil(bytes / 2 ** 20);

/// A file name as a word that a shell takes.
const shellWord = (name: string) => (/^[\w.+@:,/-]+$/.test(name) ? name : `'${name.replace(/'/g, "'\\''")}'`);

/// Matches answers to requests by their order.
abstract class QueueEngine implements Engine {
    abstract readonly place: string;
    abstract readonly formats: string;
    protected abstract readonly maxBytes: number;  // of a request
    private waiting: Waiting[] = [];
    private failure: Error | null = null;  // after which no request is answered
    private ended: (reason: string) => void = () => {};

    protected abstract send(bytes: Uint8Array): void;

    request(head: object, arrays: Record<string, NumberArray> = {}): Promise<Answer> {
        if (this.failure) return Promise.reject(this.failure);
        const bytes = bytesOfMessage(head, arrays);
        return new Promise((resolve, reject) => {
            this.checkLength(bytes.length);
            this.waiting.push({resolve, reject});
            this.send(bytes);
        });
    }

    get maxMegabytes() { return megabytes(this.maxBytes); }

    checkFile(bytes: number, name: string, options: string) { this.checkLength(bytes, name, `; type: corpuscle respond ${[shellWord(name), options].join(" ").trim()}`); }

    private checkLength(bytes: number, name = "This", command = "") {
        if (bytes > this.maxBytes) throw new Error(`${name} has ${megabytes(bytes)} MB; the engine of this page accepts ${this.maxMegabytes} MB. The command line has no such limit${command}`);
    }

    whenEnded(act: (reason: string) => void) {
        this.ended = act;
        if (this.failure) act(this.failure.message);
    }

    protected receive(buffer: ArrayBuffer) {
        const message: Message = messageOf(buffer), next = this.waiting.shift();
        if (!next) return;
        if (typeof message.head.error === "string") next.reject(new Error(message.head.error));
        else next.resolve(message);
    }

    protected fail(reason: string) {
        this.failure = new Error(reason);
        this.waiting.splice(0).forEach(({reject}) => reject(this.failure!));
        this.ended(reason);
    }
}

/// The engine as WebAssembly in a worker, which is made from texts of the page, so that the page opens from disk.
export class WorkerEngine extends QueueEngine {
    readonly place = "this browser";
    readonly formats = "CSV, JSON or NPY (the command line reads more: compressed files, HDF5, NWB, sound)";
    protected readonly maxBytes = 128 << 20;  // the memory of a page is limited
    private worker: Worker;
    private hasAnswered = false;

    /// `script`: the text of the worker; `wasm`: the module.
    constructor(script: string, wasm: ArrayBuffer) {
        super();
        const url = URL.createObjectURL(new Blob([script], {type: "text/javascript"}));
        this.worker = new Worker(url);
        this.worker.onmessage = ({data}) => {
            if (typeof data === "string") return this.end(data);
            this.hasAnswered = true;
            this.receive(data as ArrayBuffer);
        };
        this.worker.onerror = ({message}) => this.end(message || "its worker cannot be run");
        this.worker.postMessage(wasm, [wasm]);
    }

    /// `reason`: why the worker answers no more, with words of JavaScript and emscripten around it.
    private end(reason: string) {
        const plain = reason.replace(/^Uncaught /, "").replace(/\. Build with .*/, "");
        this.fail(this.hasAnswered ? `The engine has stopped (${plain}). Reload the page to start it again; its link keeps the settings.` : notStarted(plain));
    }

    protected send(bytes: Uint8Array) { this.worker.postMessage(bytes.buffer, [bytes.buffer]); }
}

/// The native engine behind the server of `corpuscle stream --serve`.
export class SocketEngine extends QueueEngine {
    readonly place = "the server";
    readonly formats = "CSV and all other formats of the command line";
    private socket: WebSocket;
    private unsent: Uint8Array[] = [];  // until the connection is open

    /// `maxBytes`: the server closes the connection after a longer message.
    constructor(url: string, protected readonly maxBytes: number) {
        super();
        this.socket = new WebSocket(url);
        this.socket.binaryType = "arraybuffer";
        this.socket.onopen = () => this.unsent.splice(0).forEach((bytes) => this.socket.send(bytes));
        this.socket.onmessage = ({data}) => this.receive(data as ArrayBuffer);
        this.socket.onclose = ({reason}) => this.fail(`The server has closed the connection${reason ? `: ${reason}` : ""}. Reload the page to connect again.`);
    }

    protected send(bytes: Uint8Array) {
        if (this.socket.readyState === WebSocket.CONNECTING) this.unsent.push(bytes);
        else if (this.socket.readyState === WebSocket.OPEN) this.socket.send(bytes);  // else onclose follows
    }
}
