// Pictures of the page, compared with small ones that are kept in pictures/: lines may move by less than a pixel of those
// and letters may have another font, but nothing may be missing, added or elsewhere.
import {existsSync, mkdirSync, readFileSync, writeFileSync} from "node:fs";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";

const kept = join(dirname(fileURLToPath(import.meta.url)), "pictures");
const width = 240;

/** A picture made small, as a PNG file (base64) and as its bytes red, green, blue. The browser does it. */
async function reduced(tab, png) {
  return tab.value(`(async () => {
    const image = new Image();
    image.src = "data:image/png;base64,${png}";
    await image.decode();
    const canvas = document.createElement("canvas"), w = ${width}, h = Math.round(image.height * w / image.width);
    canvas.width = w; canvas.height = h;
    const context = canvas.getContext("2d");
    context.imageSmoothingQuality = "high";
    context.drawImage(image, 0, 0, w, h);
    const data = context.getImageData(0, 0, w, h).data, bytes = [];
    for (let i = 0; i < data.length; i += 4) bytes.push(data[i], data[i + 1], data[i + 2]);
    return {png: canvas.toDataURL("image/png").split(",")[1], w, h, bytes};
  })()`);
}

/** How far a picture's blocks of 4 x 4 pixels are from another's: the largest difference of their means, of 255, and the
 *  share of blocks that differ by more than 24. */
function apart(a, b) {
  if (a.w !== b.w || a.h !== b.h) return {largest: 255, share: 1};
  let largest = 0, count = 0, blocks = 0;
  for (let y = 0; y + 4 <= a.h; y += 4)
    for (let x = 0; x + 4 <= a.w; x += 4) {
      let worst = 0;
      for (let c = 0; c < 3; ++c) {
        let sum = 0;
        for (let j = 0; j < 4; ++j) for (let i = 0; i < 4; ++i) {
          const k = 3 * ((y + j) * a.w + x + i) + c;
          sum += a.bytes[k] - b.bytes[k];
        }
        worst = Math.max(worst, Math.abs(sum) / 16);
      }
      largest = Math.max(largest, worst);
      count += worst > 24 ? 1 : 0;
      ++blocks;
    }
  return {largest, share: count / blocks};
}

/** Two hundredths of the blocks: the letters of another font reach less, a curve or a link that is elsewhere more. */
export const tolerance = 0.02;

/** @param tab  of an empty page, with no rules against pictures
 *  @param {string} png  as base64 @param {boolean} renew  keep it as the new one
 *  @returns the share of blocks that differ */
export async function differenceFromKept(tab, name, png, renew) {
  const file = join(kept, `${name}.png`), now = await reduced(tab, png);
  if (renew || !existsSync(file)) {
    mkdirSync(kept, {recursive: true});
    writeFileSync(file, Buffer.from(now.png, "base64"));
    return renew ? 0 : 1;
  }
  return apart(now, await reduced(tab, readFileSync(file).toString("base64"))).share;
}
