#pragma once

#include <stdexcept>
#include <string>

namespace vesica {

/// Base of every exception that leaves the library.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's input breaks a rule: a case file, an option, a surface. The message names object,
/// value and rule, in this order: `material.interface_width = -0.1: must be > 0`.
class ConfigError : public Error {
 public:
  using Error::Error;
};

/// A file or folder cannot be read or written.
class IoError : public Error {
 public:
  using Error::Error;
};

/// A numerical library refuses to go on. The message carries the call and its return code by name.
class SolverError : public Error {
 public:
  using Error::Error;
};

/// The numbers went wrong at one trial state (inverted element, NaN, singular matrix): the stepper
/// answers with a smaller step. It never leaves a stepper.
class RecoverableError : public Error {
 public:
  using Error::Error;
};

}  // namespace vesica
