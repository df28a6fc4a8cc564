/* A worker whose jobs are answered one by one. */
class Helper {
  constructor(source) {
    this.worker = new Worker(source);
    this.waiting = new Map();
    this.count = 0;
    this.worker.onmessage = ({ data }) => {
      const one = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (one && data.job === one.job) one.settle(data);
      else if (this.onmeans && data.job === "means") this.onmeans(data);
    };
  }
  ask(job, more = {}, transfer = []) {
    const id = ++this.count;
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
