// Asks bgdyn, which runs as WebAssembly in a worker, so that the page stays alive. An engine answers one request after
// the other; one that is cancelled begins anew.
import workerSource from "./worker.js?text";

/** The bytes of the module: `bgdyn_wasm.js`, beside the page, gives them as gzip in base64. */
const moduleBytes = new Promise((resolve) => { globalThis.receiveBgdyn = resolve; }).then(async (letters) => {
  if (!letters) throw new Error("the file bgdyn_wasm.js is missing beside this page");
  const packed = Uint8Array.from(atob(letters), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
});

const workerUrl = URL.createObjectURL(new Blob([workerSource], { type: "text/javascript" }));

/** The reason of a request that was cancelled. */
export class Cancelled extends Error {}

export class Engine {
  #worker = null;
  #waiting = new Map();
  #number = 0;

  /**
   * Answers a request of `bgdyn-web/src/request.rs`; `watch` receives the finished fraction of a run.
   * Fails with the answer's message, or with `Cancelled`.
   */
  async ask(request, watch = () => {}) {
    const bytes = await moduleBytes;
    this.#worker ??= this.#start(bytes);
    const number = ++this.#number;
    return new Promise((resolve, reject) => {
      this.#waiting.set(number, { resolve, reject, watch });
      this.#worker.postMessage({ number, request });
    });
  }

  /** Stops what it computes; all requests that wait fail with `Cancelled`. */
  cancel() {
    if (this.#waiting.size === 0) return;
    this.#worker?.terminate();
    this.#worker = null;
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const { reject } of waiting) reject(new Cancelled());
  }

  #start(bytes) {
    const worker = new Worker(workerUrl);
    worker.onmessage = ({ data: { number, share, answer } }) => {
      const asked = this.#waiting.get(number);
      if (!asked) return;
      if (share !== undefined) return asked.watch(share);
      this.#waiting.delete(number);
      if ("ok" in answer) asked.resolve(answer.ok);
      else asked.reject(new Error(answer.error));
    };
    worker.postMessage({ bytes });
    return worker;
  }
}
