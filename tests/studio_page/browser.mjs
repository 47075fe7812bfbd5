/** Chromium for the tests of the page, where there is one. */

import {existsSync} from 'node:fs';

const kChromium = process.env.CHROMIUM ?? '/usr/bin/chromium';

async function playwright() {
  try {
    return await import('playwright-core');
  } catch {
    return null;
  }
}

const library = await playwright();

/** Why no browser can be had, or false. */
export const noBrowser = library === null ?
    'needs playwright-core: npm install in this folder' :
    !existsSync(kChromium) && `needs a Chromium at ${kChromium}; CHROMIUM names another`;

export function launchBrowser() {
  // Without a sandbox Chromium starts for root too, as in a build container; it sees only this
  // page.
  return library.chromium.launch({executablePath: kChromium, args: ['--no-sandbox']});
}
