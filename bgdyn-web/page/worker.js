// The worker: bgdyn as WebAssembly (`bgdyn-web/src/door.rs`). Text goes through the memory of the module.
const PAUSE = 50; // ms between two fractions of a run

let module = null;
let current = 0;
let told = 0;

const progress = (share) => {
  const now = performance.now();
  if (now - told < PAUSE) return;
  told = now;
  postMessage({ number: current, share });
};

const start = (compiled) => WebAssembly.instantiate(compiled, { page: { progress } }).then((i) => i.exports);

const answerText = (bgdyn) =>
  new TextDecoder().decode(new Uint8Array(bgdyn.memory.buffer, bgdyn.bgdyn_answer_address(), bgdyn.bgdyn_answer_length()));

const answer = async (request) => {
  const { compiled } = await module;
  const bgdyn = await (await module).exports;
  const bytes = new TextEncoder().encode(JSON.stringify(request));
  const address = bgdyn.bgdyn_request(bytes.length);
  new Uint8Array(bgdyn.memory.buffer).set(bytes, address);
  try {
    bgdyn.bgdyn_answer();
  } catch (trap) {
    // A module that has trapped is not used again.
    module = Promise.resolve({ compiled, exports: start(compiled) });
    const why = trap instanceof RangeError ? trap.message : answerText(bgdyn) || trap.message;
    return { error: `bgdyn stopped by a mistake of its own, please report it with this text: ${why}` };
  }
  return JSON.parse(answerText(bgdyn));
};

let queue = Promise.resolve();
onmessage = ({ data: { bytes, number, request } }) => {
  if (bytes) {
    module = WebAssembly.compile(bytes).then((compiled) => ({ compiled, exports: start(compiled) }));
    return;
  }
  queue = queue.then(async () => {
    current = number;
    const found = await answer(request).catch((error) => ({ error: `bgdyn cannot start in this browser: ${error.message}` }));
    postMessage({ number, answer: found });
  });
};
