"use strict";
// Places for names beside their points, where they can be read.

/** @typedef {{left: number, top: number, right: number, bottom: number}} Box */

/** Points of a line close enough together that no name fits between them.
 * @param {number} ax @param {number} ay @param {number} bx @param {number} by @param {number[]} into  x and y by turns */
function addDots(ax, ay, bx, by, into) {
  const count = Math.min(400, Math.ceil(Math.hypot(bx - ax, by - ay) / 5));
  for (let i = 0; i <= count; ++i) into.push(ax + (bx - ax) * i / (count || 1), ay + (by - ay) * i / (count || 1));
}

/** The box of a name of 11 pixels' height whose base line begins here.
 * @param {number} x @param {number} y @param {string} text @returns {Box} */
function boxOfName(x, y, text) {
  return {left: x, top: y - 10, right: x + 7.5 * text.length, bottom: y + 3};
}

/** Where the name of a point can stand: on the side on which it covers fewest dots and none of the boxes; nothing where each
 * side lies on a box or leaves the room.
 * @param {number} x @param {number} y @param {string} text @param {number[]} dots @param {Box[]} boxes @param {Box} room */
function placeOfName(x, y, text, dots, boxes, room) {
  const wide = 7.5 * text.length;
  const sides = [[8, -6], [-8 - wide, -6], [8, 16], [-8 - wide, 16], [-wide / 2, -11], [-wide / 2, 21], [14, 4], [-14 - wide, 4]];
  let best = null, fewest = Infinity;
  for (const [dx, dy] of sides) {
    const box = boxOfName(x + dx, y + dy, text);
    if (box.left < room.left || box.right > room.right || box.top < room.top || box.bottom > room.bottom) continue;
    if (boxes.some(b => b.left < box.right && box.left < b.right && b.top < box.bottom && box.top < b.bottom)) continue;
    let covered = 0;
    for (let i = 0; i < dots.length; i += 2)
      if (dots[i] > box.left && dots[i] < box.right && dots[i + 1] > box.top && dots[i + 1] < box.bottom) ++covered;
    if (covered < fewest) { fewest = covered; best = {x: x + dx, y: y + dy, box}; }
    if (covered === 0) break;
  }
  return best;
}
