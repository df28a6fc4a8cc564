/* A worker whose jobs are answered one by one. */
class Helper {
  constructor(source) {
    this.worker = new Worker(source);
    this.waiting = new Map();
    this.count = 0;
    this.worker.onerror = (e) => this.fail((this.broken = e.message || "the worker failed"));
    this.worker.onmessageerror = () => this.fail("an answer of the worker could not be read");
    this.worker.onmessage = ({ data }) => {
      const one = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (one && data.job === one.job) one.settle(data);
      else if (this.onmeans && data.job === "means") this.onmeans(data);
    };
  }
  /* Whoever waits is told. */
  fail(message) {
    for (const one of this.waiting.values()) one.settle({ refused: message });
    this.waiting.clear();
  }
  ask(job, more = {}, transfer = []) {
    const id = ++this.count;
    if (this.broken) return Promise.reject(new Error(this.broken));
    return new Promise((resolve, reject) => {
      this.waiting.set(id, {
        job,
        settle: (data) =>
          data.refused === undefined ? resolve({ ...data.answer, id }) : reject(new Error(data.refused)),
      });
      this.worker.postMessage({ job, id, ...more }, transfer);
    });
  }
}
