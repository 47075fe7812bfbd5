/**
 * A function that calls `ask` for the newest arguments only: while one call is under way, later
 * ones wait, and of those only the last is made. Results of `ask` are for itself to use.
 */
export function latestOnly(ask) {
  let busy = false;
  let next = null;
  return async function call(...args) {
    next = args;
    if (busy) return;
    busy = true;
    try {
      while (next !== null) {
        const now = next;
        next = null;
        await ask(...now);
      }
    } finally {
      busy = false;
    }
  };
}
