# Bundles the TypeScript of the report pages (web/) into one script, and their style sheets into one. Sets page_files to both.
find_program(ESBUILD esbuild REQUIRED)
set(page_files ${PROJECT_BINARY_DIR}/web/page.js ${PROJECT_BINARY_DIR}/web/page.bundle.css)
file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/*.ts ${PROJECT_SOURCE_DIR}/web/*.css)
set(bundle ${ESBUILD} --bundle --minify --charset=utf8 --target=es2020,chrome112,firefox113,safari16.2 --log-level=warning)
add_custom_command(OUTPUT ${page_files} DEPENDS ${page_sources} VERBATIM
  COMMAND ${bundle} ${PROJECT_SOURCE_DIR}/web/main.ts --outfile=${PROJECT_BINARY_DIR}/web/page.js
  COMMAND ${bundle} ${PROJECT_SOURCE_DIR}/web/page.css --outfile=${PROJECT_BINARY_DIR}/web/page.bundle.css)
