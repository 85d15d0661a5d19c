#include "guarded.hpp"

#include <exception>
#include <iostream>

#include "vesica/core/error.hpp"

namespace vesica {

int guarded(std::string_view program, const std::function<int()>& run) {
  const auto fail = [&](const std::exception& error, int status) {
    std::cerr << program << ": " << error.what() << '\n';
    return status;
  };
  try {
    return run();
  } catch (const ConfigError& error) {
    return fail(error, 2);
  } catch (const IoError& error) {
    return fail(error, 4);
  } catch (const std::exception& error) {
    return fail(error, 3);
  }
}

}  // namespace vesica
