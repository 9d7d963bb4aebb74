def write(found, folder): return "-"
