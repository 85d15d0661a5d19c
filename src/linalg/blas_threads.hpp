#pragma once

extern "C" {
// Present when the BLAS of this process is OpenBLAS with threads.
int openblas_get_num_threads() __attribute__((weak));
void openblas_set_num_threads(int) __attribute__((weak));
}

namespace vesica::linalg {

/// Holds OpenBLAS to one thread for its lifetime. The dense blocks inside a sparse factorisation of
/// a surface are small: threads of the BLAS would spend their time waiting for each other.
class SingleThreadedBlas {
 public:
  SingleThreadedBlas() {
    if (openblas_get_num_threads == nullptr || openblas_set_num_threads == nullptr) return;
    previous_ = openblas_get_num_threads();
    openblas_set_num_threads(1);
  }
  SingleThreadedBlas(const SingleThreadedBlas&) = delete;
  SingleThreadedBlas& operator=(const SingleThreadedBlas&) = delete;
  ~SingleThreadedBlas() {
    if (previous_ > 0) openblas_set_num_threads(previous_);
  }

 private:
  int previous_ = 0;
};

}  // namespace vesica::linalg
