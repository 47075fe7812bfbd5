/** The hue circle in OpenCV's 256 steps (COLOR_BGR2HSV_FULL). */

export const kHues = 256;

/** Onto the circle: -1 is 255. */
export function wrapHue(hue) {
  return ((Math.round(hue) % kHues) + kHues) % kHues;
}

/** Steps between two hues the short way round, 0 … 128. */
export function hueDistance(a, b) {
  const straight = Math.abs(a - b);
  return Math.min(straight, kHues - straight);
}

/**
 * The hue of a colour of 8-bit channels, bit for bit OpenCV's; null for one without (all channels
 * equal). OpenCV scales by a table of 1/spread rounded to 1/4096.
 */
export function hueOfRgb([r, g, b]) {
  const value = Math.max(r, g, b);
  const spread = value - Math.min(r, g, b);
  if (spread === 0) return null;
  let numerator;
  if (value === r)
    numerator = g - b;
  else if (value === g)
    numerator = b - r + 2 * spread;
  else
    numerator = r - g + 4 * spread;
  const scale = Math.round((kHues * 4096) / (6 * spread));
  const hue = (numerator * scale + 2048) >> 12;
  return Math.min(hue < 0 ? hue + kHues : hue, kHues - 1);
}

/** The colour of a hue, saturation and value (0 … 255 each) as [r, g, b]. */
export function rgbOfHsv(hue, saturation, value) {
  const sixth = (hue * 6) / kHues;
  const channel = (offset) => {
    const k = (offset + sixth) % 6;
    return Math.round(value * (1 - (saturation / 255) * Math.max(0, Math.min(k, 4 - k, 1))));
  };
  return [channel(5), channel(3), channel(1)];
}
