#pragma once

#include <utility>

namespace vesica {

/// Owns one object of a C library: `release` is called once, for a value other than `T{}`.
/// Move-only; move assignment swaps, so the former object lives until the source goes.
template <class T, auto release>
class Handle {
 public:
  Handle() = default;
  explicit Handle(T object) : object_(object) {}
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, T{})) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (object_ != T{}) release(object_);
  }

  [[nodiscard]] T get() const { return object_; }
  /// Returns the address for C functions that create the object in place; valid only while nothing
  /// is owned.
  [[nodiscard]] T* address() { return &object_; }
  [[nodiscard]] explicit operator bool() const { return object_ != T{}; }
  /// Gives the object away; the caller releases it.
  [[nodiscard]] T detach() { return std::exchange(object_, T{}); }

 private:
  T object_{};
};

}  // namespace vesica
