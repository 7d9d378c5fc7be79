"""Puts the current text of files into the documents that quote them: doc/quote.py DOCUMENT.md ...

A quotation is a comment that names a file, then a block of code:

    <!-- examples/own_neuron/qif.hpp -->
    ```cpp
    ```

test/apps/documents_test.cpp fails if a block differs from its file."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
QUOTATION = re.compile(r"(<!-- (\S+) -->\n```\w*\n)(.*?)(```\n)", re.S)

for document in map(pathlib.Path, sys.argv[1:]):
    text = document.read_text()
    document.write_text(QUOTATION.sub(lambda m: m[1] + (ROOT / m[2]).read_text() + m[4], text))
