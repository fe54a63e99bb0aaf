/** Return what does something now, and at most so many times a second: what comes sooner is done at the end of the time, once. */
export function seldom(times: number, does: () => void): () => void {
  let last = -Infinity;
  let due: ReturnType<typeof setTimeout> | undefined;
  const now = () => {
    due = undefined;
    last = performance.now();
    does();
  };
  return () => {
    const wait = last + 1000 / times - performance.now();
    if (due === undefined) due = wait > 0 ? setTimeout(now, wait) : (now(), undefined);
  };
}
