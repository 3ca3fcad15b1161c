// Loses memory of its own: the suppressions of cmake/leaks.supp must not hide that.
#include <cstdio>
#include <cstdlib>

int main() {
  char* volatile lost = static_cast<char*>(std::malloc(1000));
  std::printf("%p\n", static_cast<void*>(lost));
  lost = nullptr;
  return 0;
}
