#pragma once

extern "C" {
// Present when the BLAS of this process is OpenBLAS with threads.
int openblas_get_num_threads() __attribute__((weak));
void openblas_set_num_threads(int) __attribute__((weak));
// Present when a library of this process, such as CHOLMOD, has loops of OpenMP.
int omp_get_max_active_levels() __attribute__((weak));
void omp_set_max_active_levels(int) __attribute__((weak));
}

namespace vesica::linalg {

/// Holds OpenBLAS, and loops of OpenMP in this thread, to one thread for its lifetime. The dense
/// blocks inside a sparse factorisation of a surface are small: threads of the BLAS would spend
/// their time waiting for each other.
class SingleThreadedBlas {
 public:
  SingleThreadedBlas() {
    if (omp_get_max_active_levels != nullptr && omp_set_max_active_levels != nullptr) {
      previous_levels_ = omp_get_max_active_levels();
      omp_set_max_active_levels(0);
    }
    if (openblas_get_num_threads == nullptr || openblas_set_num_threads == nullptr) return;
    previous_ = openblas_get_num_threads();
    openblas_set_num_threads(1);
  }
  SingleThreadedBlas(const SingleThreadedBlas&) = delete;
  SingleThreadedBlas& operator=(const SingleThreadedBlas&) = delete;
  ~SingleThreadedBlas() {
    if (previous_ > 0) openblas_set_num_threads(previous_);
    if (previous_levels_ > 0) omp_set_max_active_levels(previous_levels_);
  }

 private:
  int previous_ = 0;
  int previous_levels_ = 0;
};

}  // namespace vesica::linalg
