// The worker of the page's engine. Its first message is the WebAssembly module, each further one a request; it answers in order.
// A text in place of an answer says why there will be none.
export {};

interface Module {
    HEAPU8: Uint8Array;
    _corpuscle_page_create(): number;
    _corpuscle_page_request(engine: number, request: number, length: number): number;
    _corpuscle_page_answer_length(engine: number): number;
    _malloc(bytes: number): number;
    _free(at: number): void;
}
declare const makeEngine: (options: {wasmBinary: ArrayBuffer}) => Promise<Module>;

let module: Module | null = null, engine = 0;
const waiting: ArrayBuffer[] = [];  // requests that came before the engine had started
const scope = self as unknown as {onmessage: (event: MessageEvent) => void; postMessage(data: unknown, transfer?: Transferable[]): void};

function answer(request: ArrayBuffer) {
    const at = module!._malloc(request.byteLength);
    module!.HEAPU8.set(new Uint8Array(request), at);
    const begin = module!._corpuscle_page_request(engine, at, request.byteLength), length = module!._corpuscle_page_answer_length(engine);
    module!._free(at);
    const bytes = module!.HEAPU8.slice(begin, begin + length);
    scope.postMessage(bytes.buffer, [bytes.buffer]);
}

scope.onmessage = ({data}) => {
    scope.onmessage = (event) => { if (module) answer(event.data); else waiting.push(event.data); };
    makeEngine({wasmBinary: data}).then((made) => {
        engine = made._corpuscle_page_create();
        module = made;
        waiting.splice(0).forEach(answer);
    }).catch((error: Error) => scope.postMessage(String(error.message || error)));
};
