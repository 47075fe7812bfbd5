/**
 * Paints the hue plane: regions of the labels with their borders, the frame's pixels, exclusions.
 */

import {bytesOf} from './api.mjs';
import {kHalf, kPlaneSize, rectanglesOf} from './exclusions.mjs';

/** Labels and counts of the plane's cells, row by row, from the server's answers. */
export function labelsOf(plane) {
  return bytesOf(plane.labels);
}
export function countsOf(density) {
  const counts = new Uint8Array(kPlaneSize * kPlaneSize);
  counts.set(bytesOf(density.hue_value.counts).subarray(0, kPlaneSize * kHalf));
  counts.set(
      bytesOf(density.hue_saturation.counts).subarray(0, kPlaneSize * kHalf), kPlaneSize * kHalf);
  return counts;
}

/**
 * @param {{labels: ?Uint8Array, counts: ?Uint8Array, exclusions: object[], palette: Palette,
 *     dark: boolean}} plane
 */
export function paintPlane(canvas, plane) {
  const scale_px = devicePixelRatio;
  const width = Math.max(1, Math.round(canvas.clientWidth * scale_px));
  const height = Math.max(1, Math.round(canvas.clientHeight * scale_px));
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
  const context = canvas.getContext('2d');
  context.imageSmoothingEnabled = false;
  context.drawImage(cells(plane), 0, 0, width, height);
  const [cellWidth, cellHeight] = [width / kPlaneSize, height / kPlaneSize];
  context.fillStyle = plane.dark ? '#ffffffb0' : '#000000a0';
  if (plane.labels !== null) fillBorders(context, plane.labels, cellWidth, cellHeight, scale_px);
  context.fillRect(0, height / 2 - scale_px, width, 2 * scale_px);
  for (const exclusion of plane.exclusions) {
    for (const rectangle of rectanglesOf(exclusion)) {
      strike(
          context, plane.dark, {
            x: rectangle.x * cellWidth,
            y: rectangle.y * cellHeight,
            width: rectangle.width * cellWidth,
            height: rectangle.height * cellHeight,
          },
          scale_px);
    }
  }
}

function cells({labels, counts, palette, dark}) {
  const image = new ImageData(kPlaneSize, kPlaneSize);
  const ground = dark ? [16, 19, 24] : [250, 250, 251];
  const ink = dark ? [255, 255, 255] : [0, 0, 0];
  const tint = dark ? 0.42 : 0.5;
  const mixed = (from, to, part) => from.map((channel, i) => channel + (to[i] - channel) * part);
  const tints = Array.from({length: 256}, (_, label) => {
    const name = palette.nameOfLabel(label);
    return name === null ? ground : mixed(ground, palette.rgb(name), tint);
  });
  for (let i = 0; i < kPlaneSize * kPlaneSize; ++i) {
    const count = counts?.[i] ?? 0;
    const base = tints[labels?.[i] ?? 0];
    const part = count === 0 ? 0 : 0.35 + (0.6 * count) / 255;
    for (let c = 0; c < 3; ++c) image.data[4 * i + c] = base[c] + (ink[c] - base[c]) * part;
    image.data[4 * i + 3] = 255;
  }
  const canvas = new OffscreenCanvas(kPlaneSize, kPlaneSize);
  canvas.getContext('2d').putImageData(image, 0, 0);
  return canvas;
}

function fillBorders(context, labels, cellWidth, cellHeight, line) {
  for (let row = 0; row < kPlaneSize; ++row) {
    for (let hue = 0; hue < kPlaneSize; ++hue) {
      const label = labels[row * kPlaneSize + hue];
      const x = hue * cellWidth;
      const y = row * cellHeight;
      if (hue > 0 && labels[row * kPlaneSize + hue - 1] !== label) {
        context.fillRect(x - line / 2, y, line, cellHeight);
      }
      if (row > 0 && row !== kHalf && labels[(row - 1) * kPlaneSize + hue] !== label) {
        context.fillRect(x, y - line / 2, cellWidth, line);
      }
    }
  }
}

function strike(context, dark, {x, y, width, height}, line) {
  context.save();
  context.beginPath();
  context.rect(x, y, width, height);
  context.strokeStyle = dark ? '#fff' : '#000';
  context.lineWidth = 2 * line;
  context.setLineDash([5 * line, 3 * line]);
  context.stroke();
  context.clip();
  context.setLineDash([]);
  context.lineWidth = line;
  context.globalAlpha = 0.55;
  context.beginPath();
  for (let from = -height; from < width; from += 8 * line) {
    context.moveTo(x + from, y + height);
    context.lineTo(x + from + height, y);
  }
  context.stroke();
  context.restore();
}
