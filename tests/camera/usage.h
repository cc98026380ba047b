// Checks that a call is refused as wrong usage, in words that name what is wrong.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "image/error.h"

template <class Call>
void expect_usage_error(Call&& call, const std::string& part_of_message) {
  try {
    call();
    ADD_FAILURE() << "accepted; expected an error about " << part_of_message;
  } catch (const pullfocus::Error& error) {
    EXPECT_EQ(error.code(), pullfocus::ErrorCode::usage);
    EXPECT_NE(std::string(error.what()).find(part_of_message), std::string::npos)
        << "'" << error.what() << "' does not say '" << part_of_message << "'";
  }
}
