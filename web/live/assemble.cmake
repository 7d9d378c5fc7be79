# Puts script and styles of the live page into the shell of all pages: cmake -D SHELL=web/shell.html -D DIRECTORY=build/page -P assemble.cmake
file(READ ${SHELL} page)
file(READ ${DIRECTORY}/press.js script)
file(READ ${DIRECTORY}/press.css style)
file(READ ${DIRECTORY}/engine.txt engine)
string(REPLACE "{{title}}" "Press a skin" page "${page}")
string(REPLACE "{{style}}" "${style}" page "${page}")
string(REPLACE "{{data}}" "{}" page "${page}")
string(REPLACE "<script>{{script}}" "<script type=\"text/plain\" id=\"engine\">${engine}</script>\n<script>{{script}}" page "${page}")
# The page makes a worker, which compiles WebAssembly. A page that a server has sent opens a WebSocket to it.
string(REPLACE "script-src 'unsafe-inline'" "script-src 'unsafe-inline' 'wasm-unsafe-eval'; worker-src blob:; connect-src 'self'" page "${page}")
string(REPLACE "{{script}}" "${script}" page "${page}")
file(WRITE ${DIRECTORY}/press.html.part "${page}")
file(RENAME ${DIRECTORY}/press.html.part ${DIRECTORY}/press.html)
