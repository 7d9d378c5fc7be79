// Arrays of numbers in the data of a page. In a file an array is {"f32": base64}; in a message of the engine it follows the head as bytes.

export type NumberArray = Float32Array | Float64Array | Uint32Array | Uint16Array | Uint8Array;
export interface EncodedArray { f32?: string; f64?: string; u32?: string; u16?: string; u8?: string }

const TYPES = {f32: Float32Array, f64: Float64Array, u32: Uint32Array, u16: Uint16Array, u8: Uint8Array};
type TypeName = keyof typeof TYPES;

export function bytesOf(base64: string): Uint8Array {
    const text = atob(base64), bytes = new Uint8Array(text.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
}

/// The numbers of an array of a page's data. The length of the base64 text is a multiple of the size of a number.
export function decoded<T extends NumberArray = NumberArray>(array: EncodedArray): T {
    const [type, base64] = Object.entries(array)[0] as [TypeName, string];
    return new TYPES[type](bytesOf(base64).buffer) as T;
}

export interface Message { head: Record<string, unknown>; arrays: Record<string, NumberArray> }
interface ArrayEntry { name: string; type: TypeName; count: number }

const padded = (bytes: number) => Math.ceil(bytes / 8) * 8;

/// Splits a message of the engine: length of the head (u32, little-endian), head (JSON), arrays at multiples of 8 bytes. Throws an Error if the
/// message is shorter than its head says.
export function messageOf(buffer: ArrayBuffer): Message {
    const length = buffer.byteLength < 4 ? Infinity : new DataView(buffer).getUint32(0, true);
    if (4 + length > buffer.byteLength) throw new Error("The message of the engine is incomplete.");
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    const arrays: Record<string, NumberArray> = {};
    let at = 4 + length;
    for (const {name, type, count} of (head.arrays || []) as ArrayEntry[]) {
        arrays[name] = new TYPES[type](buffer, at, count);
        at += padded(arrays[name].byteLength);
    }
    return {head, arrays};
}

/// The message with a head and arrays. `head` must not have the key "arrays".
export function bytesOfMessage(head: object, arrays: Record<string, NumberArray> = {}): Uint8Array {
    const entries = Object.entries(arrays).map(([name, array]) => ({name, type: typeOf(array), count: array.length}));
    const text = new TextEncoder().encode(JSON.stringify({...head, arrays: entries}));
    const length = padded(4 + text.length) - 4;
    const out = new Uint8Array(4 + length + Object.values(arrays).reduce((sum, array) => sum + padded(array.byteLength), 0));
    new DataView(out.buffer).setUint32(0, length, true);
    out.fill(32, 4, 4 + length).set(text, 4);
    let at = 4 + length;
    for (const array of Object.values(arrays)) {
        out.set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), at);
        at += padded(array.byteLength);
    }
    return out;
}

const typeOf = (array: NumberArray) => (Object.keys(TYPES) as TypeName[]).find((name) => array instanceof TYPES[name])!;

/// The number of elements of an ascending array that are smaller than t.
export function firstAt(times: ArrayLike<number>, t: number): number {
    let low = 0, high = times.length;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (times[middle] < t) low = middle + 1;
        else high = middle;
    }
    return low;
}

/// Numbers of a page's data: encoded, or a list in which null stands for a number that is not known.
export type Numbers = EncodedArray | (number | null)[];

/// The numbers, with NaN for those that are not known.
export const numbersOf = (values: Numbers): Float32Array | Float64Array =>
    (Array.isArray(values) ? Float64Array.from(values, (v) => v ?? NaN) : decoded<Float32Array>(values));

/// The arrays "NAME.0", "NAME.1" ... of an answer.
export function numberedArrays(arrays: Record<string, NumberArray>, name: string): Float32Array[] {
    const out: Float32Array[] = [];
    for (let k = 0; arrays[`${name}.${k}`]; ++k) out.push(arrays[`${name}.${k}`] as Float32Array);
    return out;
}
