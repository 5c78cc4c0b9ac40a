// The numbers behind the plots: a ring of rows, one for each state that arrived.

/** Rows of 60 s at the highest rate a scene may ask for (120 Hz), and a few more. */
const CAPACITY = 7500;

export class Series {
  private readonly values: Float64Array;
  private next = 0;
  private filled = 0;

  /** Each row has a time and `columns` values. */
  constructor(
    readonly columns: number,
    private readonly capacity: number = CAPACITY,
  ) {
    this.values = new Float64Array(capacity * (columns + 1));
  }

  get length(): number {
    return this.filled;
  }

  /** Append a row, in place of the oldest one when the ring is full; `row[c]` is NaN where nothing is known. */
  push(timeS: number, row: ArrayLike<number>): void {
    const at = this.next * (this.columns + 1);
    this.values[at] = timeS;
    for (let column = 0; column < this.columns; column += 1) this.values[at + 1 + column] = row[column];
    this.next = (this.next + 1) % this.capacity;
    this.filled = Math.min(this.filled + 1, this.capacity);
  }

  /** Time of row `i`, the oldest first. */
  timeS(i: number): number {
    return this.values[this.offset(i)];
  }

  value(i: number, column: number): number {
    return this.values[this.offset(i) + 1 + column];
  }

  /** The first row that is not before a time. */
  firstSince(timeS: number): number {
    let [low, high] = [0, this.filled];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.timeS(middle) < timeS) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Times of rows `from` to `to`. */
  times(from: number, to: number): number[] {
    return Array.from({ length: to - from }, (_, i) => this.timeS(from + i));
  }

  /** Values of a column in rows `from` to `to`; null where nothing is known, so that a plot shows a gap. */
  column(column: number, from: number, to: number): (number | null)[] {
    return Array.from({ length: to - from }, (_, i) => {
      const value = this.value(from + i, column);
      return Number.isFinite(value) ? value : null;
    });
  }

  /** The same rows, whatever is appended to this one later. */
  copy(): Series {
    const copy = new Series(this.columns, this.capacity);
    copy.values.set(this.values);
    copy.next = this.next;
    copy.filled = this.filled;
    return copy;
  }

  private offset(i: number): number {
    const oldest = this.filled < this.capacity ? 0 : this.next;
    return ((oldest + i) % this.capacity) * (this.columns + 1);
  }
}
