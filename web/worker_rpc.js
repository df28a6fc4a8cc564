/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls of a worker (RPC): each job is a promise of its answer. */

/* The workers of the page: `live` runs the gas that is shown, `measure` its means, `evaluate` its theories (gas.js opens
 * them). */
export const workers = { live: null, measure: null, evaluate: null };

export class WorkerClient {
  constructor(source) {
    this.worker = new Worker(source);
    this.pending = new Map();
    this.count = 0;
    this.worker.onerror = (e) => this.fail((this.broken = e.message || "the worker failed"));
    this.worker.onmessageerror = () => this.fail("an answer of the worker could not be read");
    this.worker.onmessage = ({ data }) => {
      const one = this.pending.get(data.id);
      this.pending.delete(data.id);
      if (one && data.job === one.job) one.settle(data);
      else if (this[`on${data.job}`]) this[`on${data.job}`](data);
    };
  }
  /* Reject every promise that is open. */
  fail(message) {
    for (const one of this.pending.values()) one.settle({ refused: message });
    this.pending.clear();
  }
  /* End the worker and reject its open promises. */
  end(message) {
    this.worker.terminate();
    this.fail((this.broken = message));
  }
  request(job, more = {}, transfer = []) {
    const id = ++this.count;
    if (this.broken) return Promise.reject(new Error(this.broken));
    return new Promise((resolve, reject) => {
      this.pending.set(id, {
        job,
        settle: (data) =>
          data.refused === undefined ? resolve({ ...data.answer, id }) : reject(new Error(data.refused)),
      });
      this.worker.postMessage({ job, id, ...more }, transfer);
    });
  }
}
