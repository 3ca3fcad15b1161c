// SPDX-License-Identifier: GPL-3.0-or-later
// Amplitude spectrum of a history: evenly sampled, mean removed, Hann window, fast Fourier transform.

/** In place, radix 2: X_k = sum x_n exp(-2 pi i k n / N); N a power of two. */
export function transform(re: Float64Array, im: Float64Array): void {
  const n = re.length;
  for (let i = 1, j = 0; i < n; ++i) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) [re[i], re[j], im[i], im[j]] = [re[j]!, re[i]!, im[j]!, im[i]!];
  }
  for (let size = 2; size <= n; size *= 2)
    for (let k = 0; k < size / 2; ++k) {
      const angle = (-2 * Math.PI * k) / size, c = Math.cos(angle), s = Math.sin(angle);
      for (let i = k; i < n; i += size) {
        const j = i + size / 2, x = re[j]! * c - im[j]! * s, y = re[j]! * s + im[j]! * c;
        re[j] = re[i]! - x;
        im[j] = im[i]! - y;
        re[i]! += x;
        im[i]! += y;
      }
    }
}

/** Value at t between the rows, NaN outside. */
export function valueAt(times: ArrayLike<number>, values: ArrayLike<number>, t: number): number {
  const last = times.length - 1;
  if (last < 0 || t < times[0]! || t > times[last]!) return NaN;
  let low = 0, high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= t) low = middle;
    else high = middle;
  }
  const step = times[high]! - times[low]!;
  if (t === times[low]! || !(step > 0)) return values[t === times[high]! ? high : low]!;
  return values[low]! + ((t - times[low]!) / step) * (values[high]! - values[low]!);
}

export interface Spectrum {
  frequency: Float64Array;
  /** Amplitude of a sine of that frequency, in the unit of the history. */
  amplitude: Float64Array;
  samples: number;
  interval: number;
}

const MOST = 16384;

export function spectrumOf(times: ArrayLike<number>, values: ArrayLike<number>, begin: number, end: number): Spectrum | null {
  let inside = 0;
  for (let i = 0; i < times.length; ++i) if (times[i]! >= begin && times[i]! <= end) ++inside;
  if (inside < 8 || !(end > begin)) return null;
  const n = Math.min(MOST, 2 ** Math.ceil(Math.log2(inside))), interval = (end - begin) / n;
  const re = new Float64Array(n), im = new Float64Array(n);
  for (let i = 0; i < n; ++i) re[i] = valueAt(times, values, begin + i * interval);
  if (re.some((x) => !Number.isFinite(x))) return null;
  const mean = re.reduce((sum, x) => sum + x, 0) / n;
  // The Hann window halves the amplitude of a sine.
  for (let i = 0; i < n; ++i) re[i] = (re[i]! - mean) * (0.5 - 0.5 * Math.cos((2 * Math.PI * i) / n));
  transform(re, im);
  const half = n / 2;
  const spectrum = { frequency: new Float64Array(half - 1), amplitude: new Float64Array(half - 1), samples: n, interval };
  for (let k = 1; k < half; ++k) {
    spectrum.frequency[k - 1] = k / (n * interval);
    spectrum.amplitude[k - 1] = (4 / n) * Math.hypot(re[k]!, im[k]!);
  }
  return spectrum;
}
