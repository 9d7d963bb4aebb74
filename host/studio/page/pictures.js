// Binary messages into pictures (docs/studio-protocol.md, "Pictures").

const kMagic = 0x5352414d, kHeadBytes = 32, kRectBytes = 8;
export const kRaw = 0, kDeflate = 1, kJpeg = 2;

// Null where it is no picture. `pixels` is a window into the buffer, not a copy.
export function readPicture(buffer) {
  const bytes = new DataView(buffer);
  if (buffer.byteLength < kHeadBytes || bytes.getUint32(0, true) !== kMagic) return null;
  const rects = readRects(bytes, bytes.getUint32(28, true));
  const flags = bytes.getUint16(26, true);
  return {
    view: bytes.getUint32(4, true),
    picture: bytes.getUint32(8, true),
    edit: bytes.getUint32(12, true) + bytes.getUint32(16, true) * 2 ** 32,
    width: bytes.getUint16(20, true),
    height: bytes.getUint16(22, true),
    encoding: bytes.getUint16(24, true),
    rests: (flags & 1) !== 0,
    exact: (flags & 2) !== 0,
    rects,
    pixels: new Uint8ClampedArray(buffer, kHeadBytes + kRectBytes * rects.length),
  };
}

function readRects(bytes, count) {
  return Array.from({length: count}, (_, i) => {
    const at = kHeadBytes + kRectBytes * i;
    const [x, y, width, height] = [0, 2, 4, 6].map((offset) => bytes.getUint16(at + offset, true));
    return {x, y, width, height};
  });
}

// What can be painted at once: raw as it came; others are promises of it.
export function decode(picture) {
  if (picture.encoding === kDeflate) return inflate(picture);
  if (picture.encoding === kJpeg) return decodeJpeg(picture);
  return picture;
}

async function inflate(picture) {
  const stream = new Blob([picture.pixels]).stream().pipeThrough(new DecompressionStream("deflate"));
  return {...picture, pixels: new Uint8ClampedArray(await new Response(stream).arrayBuffer())};
}

async function decodeJpeg(picture) {
  const options = {colorSpaceConversion: "none", premultiplyAlpha: "none"};
  return {...picture, bitmap: await createImageBitmap(new Blob([picture.pixels], {type: "image/jpeg"}), options)};
}

// Into a 2d context whose canvas has the picture's size.
export function paint(context, picture) {
  if (picture.bitmap) {
    context.drawImage(picture.bitmap, 0, 0, picture.width, picture.height);
    picture.bitmap.close();
    return;
  }
  let at = picture.pixels.byteOffset;
  for (const {x, y, width, height} of picture.rects) {
    const pixels = new Uint8ClampedArray(picture.pixels.buffer, at, width * height * 4);
    context.putImageData(new ImageData(pixels, width, height), x, y);
    at += pixels.length;
  }
}
