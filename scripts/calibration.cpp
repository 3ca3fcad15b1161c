// SPDX-License-Identifier: GPL-3.0-or-later
// A fixed piece of work for scripts/readme_times: products of small matrices and walks through 8 MB, as in a run of a
// mechanism. Prints its processor seconds, the median of five. Nothing here changes with the project.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <vector>

int main() {
  constexpr int size = 12, places = 1 << 20;
  std::vector<double> field(places, 1.0 / places);
  std::array<std::array<double, size>, size> a{}, b{};
  std::array<double, 5> seconds{};
  double sum = 0.0;
  for (double& time : seconds) {
    const std::clock_t begin = std::clock();
    for (unsigned round = 0; round < 400000; ++round) {
      for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) a[i][j] = field[(round * 7919u + static_cast<unsigned>(i * size + j)) % places];
      b = {};
      for (int i = 0; i < size; ++i)
        for (int k = 0; k < size; ++k)
          for (int j = 0; j < size; ++j) b[i][j] += a[i][k] * a[k][j];
      unsigned at = round;
      for (int step = 0; step < 200; ++step) {
        at = (at * 1664525u + 1013904223u) % places;
        field[at] += b[step % size][step % size];
      }
    }
    time = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    sum += field[places / 2];
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf("%.3f\n", seconds[2]);
  return sum > 0.0 ? 0 : 1;
}
