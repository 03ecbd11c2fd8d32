FROM python:3.12-slim

# First what seldom changes: the dependencies, in exactly the versions and with the hashes of the lock file.
COPY app/requirements.lock /src/app/
RUN pip install --no-cache-dir --require-hashes -r /src/app/requirements.lock

COPY pyproject.toml README.md LICENSE /src/
COPY app /src/app
COPY models /src/models
COPY static /src/static
RUN pip install --no-cache-dir --no-deps --no-build-isolation /src

RUN useradd --create-home explorer
USER explorer
# Away from /src: what runs is the installed package.
WORKDIR /home/explorer

# The kernels are compiled here, by the user who runs them: the cache must be writable for Numba to use it.
# It holds for the CPU it was made on; on another kind the container compiles once more as it starts.
ENV NUMBA_CACHE_DIR=/home/explorer/.cache
RUN python -c "from hess_explorer.server.warm import compile_all; compile_all()"

EXPOSE 5006
HEALTHCHECK --start-period=30s --timeout=5s \
    CMD ["python", "-c", "from urllib.request import urlopen; urlopen('http://127.0.0.1:5006/liveness', timeout=4)"]
# Served under another name or address: --allow-origin HOST:PORT as the browser's address bar shows it.
CMD ["hess-explorer", "serve", "--address", "0.0.0.0", "--port", "5006", "--no-browser", \
     "--allow-origin", "localhost:5006"]
