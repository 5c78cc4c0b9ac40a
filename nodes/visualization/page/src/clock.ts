// The time axis of the last minute: the server's time, so that rows lie as far apart as what they tell, not as the page
// got round to them.

/** A step back, or this much more than has passed on the page, is another clock of the server, s. */
const OTHER_CLOCK_S = 60;
/** A surface whose stamp is further than this before the newest state, or after now, is stamped by another clock, s. */
const SAME_CLOCK_S = 1;

export class Clock {
  private last: { readonly serverS: number; readonly arrivalS: number } | null = null;
  private offsetS = 0;
  private surfaceS = -Infinity;

  /** Where a state belongs, s: its server's time and a constant, so that the axis begins at the page's time. */
  ofState(serverS: number, arrivalS: number): number {
    const { last } = this;
    if (last === null) {
      this.offsetS = arrivalS - serverS;
    } else {
      const aheadS = serverS - last.serverS - (arrivalS - last.arrivalS);
      // The axis goes on: what was recorded keeps its place.
      if (serverS < last.serverS || aheadS > OTHER_CLOCK_S) this.offsetS = last.serverS + this.offsetS + (arrivalS - last.arrivalS) - serverS;
    }
    this.last = { serverS, arrivalS };
    return serverS + this.offsetS;
  }

  /** Where a surface belongs, s: its stamp where that is of the server's clock, otherwise when it arrived. Never goes back. */
  ofSurface(stampS: number, arrivalS: number): number {
    const { last, offsetS } = this;
    const arrivedS = last === null ? arrivalS : last.serverS + offsetS + (arrivalS - last.arrivalS);
    const stampedS = stampS + offsetS;
    // A page that was held up takes what came meanwhile later than it is.
    const ofServer = last !== null && stampedS > last.serverS + offsetS - SAME_CLOCK_S && stampedS < arrivedS + SAME_CLOCK_S;
    this.surfaceS = Math.max(ofServer ? stampedS : arrivedS, this.surfaceS);
    return this.surfaceS;
  }
}
