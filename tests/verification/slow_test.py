"""Every verification case with all its lattices, orders and spacings: the numbers of docs/verification.md."""
import unittest

import fast_test

fast_test.FULL = True
Verification = fast_test.Verification  # unittest finds it here

if __name__ == "__main__":
    unittest.main()
