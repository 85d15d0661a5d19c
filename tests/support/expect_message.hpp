#pragma once

#include <gtest/gtest.h>

#include <string>

namespace vesica::test {

/// Runs `action`, which has to throw an `E` whose message contains `text`.
template <class E, class Action>
void expect_message(const Action& action, const std::string& text) {
  try {
    action();
  } catch (const E& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(text), std::string::npos) << "message: " << message;
    return;
  }
  ADD_FAILURE() << "nothing thrown; expected: " << text;
}

}  // namespace vesica::test
