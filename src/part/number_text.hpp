// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Decimal text to double without the C library's locale: "0,5" must not depend on where the controller stands.

#pragma once

namespace pose_wall {

// Reads [+-]digits[.digits][e[+-]digits] from *cursor and moves it behind the number. False (cursor unmoved) where
// there is none. Exact for up to 15 digits and exponents within +-22; otherwise within 1e-15 relative.
bool read_number(const char** cursor, double* value);

// The whole text is one number, with spaces around it allowed.
bool whole_number_text(const char* text, double* value);

void skip_spaces(const char** cursor);

}  // namespace pose_wall
