// A link that holds both files: deflated JSON in base64 after the `#`.
const through = async (bytes, stream) =>
  new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

/** Returns the address of this page with these files. */
export const linkOf = async (files) => {
  const packed = await through(new TextEncoder().encode(JSON.stringify(files)), new CompressionStream("deflate-raw"));
  const letters = btoa(Array.from(packed, (b) => String.fromCharCode(b)).join(""));
  const url = new URL(location.href);
  url.hash = letters.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  return url.href;
};

const isFile = (file) => typeof file?.name === "string" && typeof file?.text === "string";

/** Returns the files in the address of this page; null if there are none, or if it was cut. */
export const filesOfLink = async () => {
  const letters = location.hash.slice(1);
  if (!letters) return null;
  try {
    const packed = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
    const files = JSON.parse(new TextDecoder().decode(await through(packed, new DecompressionStream("deflate-raw"))));
    return isFile(files.mechanism) && isFile(files.scene) ? files : null;
  } catch {
    return null;
  }
};
