import {ApiError} from './api.mjs';

/**
 * A function that asks without telling when there was no answer: for what only keeps a display up
 * to date, as the banner tells when the server is gone.
 */
export function quietly(ask) {
  return async (...args) => {
    try {
      await ask(...args);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
    }
  };
}
