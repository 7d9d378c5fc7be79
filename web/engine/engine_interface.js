// Added to the generated code: Module.openEngine() returns a session. The protocol is that of doc/page-protocol.md.
//   const module = await corpuscleEngine();
//   const session = module.openEngine();
//   const answer = session.request(bytes);  // Uint8Array of a request to Uint8Array of its answer
Module["openEngine"] = function () {
  const engine = _corpuscle_create();
  return {
    request(bytes) {
      const at = _malloc(Math.max(1, bytes.length));
      if (!at) throw new Error("the page has no memory left for a request of " + bytes.length + " bytes");
      HEAPU8.set(bytes, at);
      const answer = _corpuscle_request(engine, at, bytes.length);
      _free(at);
      return HEAPU8.slice(answer, answer + _corpuscle_answer_size(engine));
    },
    close() {
      _corpuscle_free(engine);
    },
  };
};
